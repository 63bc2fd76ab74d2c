// The parts of a glTF file that geometry needs: its JSON, and the bytes of its buffers.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "io/numbers.h"
#include "io/readers.h"

namespace relievo::io {

using Json = nlohmann::json;

// A run of vectors in a buffer.
struct Accessor {
  const char* first = nullptr;
  std::size_t count = 0, components = 1, stride = 0;
  NumberType type = NumberType::float32;
  double scale = 1;  // of normalised integers

  // Appends `components` values of each vector to `values`.
  void decode(std::vector<double>& values) const;
};

// glTF 2.0 as JSON with embedded buffers, or binary (GLB). Views point into the source or into the object.
class GltfFile {
 public:
  static Result<GltfFile> open(const Source& source);

  const Json& json() const { return json_; }

  // Element i of an array of the file's root, an object; null if there is none.
  const Json* element(std::string_view array, std::size_t i) const;

  // Fails for an accessor that does not exist or does not fit into its buffer. `place` names who wants it.
  Result<Accessor> accessor(const Source& source, std::size_t i, const std::string& place) const;

 private:
  Result<void> split_glb(const Source& source, std::string_view& text);
  Result<void> take_buffers(const Source& source);

  Json json_;
  std::string_view binary_;           // GLB's own buffer
  std::vector<std::string> decoded_;  // buffers that were base64 text
  std::vector<std::string_view> buffers_;
};

// A member that is a whole number from 0 on, or `otherwise` where it is missing; nothing if it is another.
std::optional<std::size_t> number_in(const Json& object, const char* name, std::size_t otherwise);

}  // namespace relievo::io
