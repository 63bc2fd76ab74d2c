// The parts of a glTF file that geometry needs: its JSON, and the bytes of its buffers.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "io/numbers.h"
#include "io/readers.h"

namespace relievo::io {

using Json = nlohmann::json;

// An array of vectors in a buffer.
struct Accessor {
  const char* first = nullptr;
  std::size_t count = 0, components = 1, stride = 0;
  NumberType type = NumberType::float32;
  double scale = 1;  // factor of normalised integers, else 1

  // Appends `components` values of each vector to `values`.
  void decode(std::vector<double>& values) const;
};

// glTF 2.0 as JSON with embedded buffers, or binary (GLB). Views point into the source or into the object.
class GltfFile {
 public:
  static Result<GltfFile> open(const Source& source);

  const Json& json() const { return json_; }

  // Returns element i of an array in the file's root if it is an object, else null.
  const Json* element(std::string_view array, std::size_t i) const;

  // Returns accessor i. Errors: kind input, at `place`, if it does not exist or does not fit into its buffer.
  Result<Accessor> accessor(const Source& source, std::size_t i, const std::string& place) const;

 private:
  Result<void> split_glb(const Source& source, std::string_view& text);
  Result<void> take_buffers(const Source& source);

  Json json_;
  std::string_view binary_;           // GLB's own buffer
  std::vector<std::string> decoded_;  // buffers that were base64 text
  std::vector<std::string_view> buffers_;
};

// Returns a member that is a non-negative integer; `otherwise` if it is missing; nothing if it is anything
// else.
std::optional<std::size_t> number_in(const Json& object, const char* name, std::size_t otherwise);

}  // namespace relievo::io
