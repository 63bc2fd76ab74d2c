// Reads the parts of a glTF file that determine geometry: its JSON, and the numbers in its buffers. Tested by
// tests/io/gltf_test.cpp and tests/io/mesh_formats_test.cpp.
#pragma once

#include <Eigen/Geometry>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "io/numbers.h"
#include "io/readers.h"
#include "io/texture.h"

namespace relievo::io {

using Json = nlohmann::json;

// The numbers of an accessor: consecutive vectors of `components` numbers.
struct AccessorValues {
  std::size_t components = 1;
  std::vector<double> numbers;
  NumberType type = NumberType::float32;  // type of the numbers in the file

  std::size_t count() const { return numbers.size() / components; }
};

// Vectors in a buffer that are `stride` bytes apart.
struct BufferRows {
  const char* first = nullptr;
  std::size_t stride = 0;
};

// A glTF 2.0 file, as JSON or binary (GLB). Buffers are loaded when an accessor first needs them, so unused
// buffers may be missing. The source must outlive the object.
class GltfFile {
 public:
  static Result<GltfFile> open(const Source& source);

  const Json& json() const { return json_; }

  // Returns element i of an array in the file's root if that element is an object, else null.
  const Json* element(std::string_view array, std::size_t i) const;

  // Returns the numbers of accessor i. Errors: kind input, at `place`, if the accessor does not exist or does
  // not fit into its buffer, or if the buffer is not available.
  Result<AccessorValues> accessor(std::size_t i, const std::string& place);

  // Returns the bytes of image i; nothing if it does not exist or is not available.
  std::optional<std::string_view> image(std::size_t i);

 private:
  // The layout of an accessor's numbers, according to its JSON.
  struct Layout {
    std::size_t count = 0, components = 0;
    NumberType type = NumberType::float32;
    double scale = 1;  // factor for normalised integers; 1 for other numbers
  };

  explicit GltfFile(const Source& source) : source_(&source) {}
  Result<void> split_glb(std::string_view& text);
  Result<void> check_version() const;
  Result<std::string_view> buffer(std::size_t i, const Json& json);
  Result<std::string_view> part_of_buffer(const Json& part, const std::string& place);
  Result<std::string_view> view(std::size_t i, const std::string& place);
  Result<std::vector<std::byte>> data_in_uri(std::string_view uri, const std::string& place) const;
  Result<std::string_view> load(const std::string& uri, const std::string& place);
  Result<Layout> layout_of(const Json& json, const std::string& place) const;
  Result<BufferRows> rows(const Json& in_view, const Layout& layout, const std::string& place);
  Result<void> replace_sparse(const Json& sparse, const Layout& layout, const std::string& place,
                              AccessorValues& out);

  const Source* source_;
  Json json_;
  std::string_view binary_;                                // the buffer inside a GLB
  std::map<std::string, std::vector<std::byte>> loaded_;   // contents of buffers, by URI
  std::map<std::size_t, std::vector<std::byte>> decoded_;  // bytes of compressed views, by the view's index
};

// Returns the value if it is a non-negative integer, also written as 4.0; nothing for any other value.
std::optional<std::size_t> whole_number(const Json& value);

// Returns the named member if it is a non-negative integer; `otherwise` if it is missing; nothing for any
// other value.
std::optional<std::size_t> number_in(const Json& object, const char* name, std::size_t otherwise);

// Returns the object's members with these names as a text for messages: count -4, type "VEC3".
std::string shown_members(const Json& object, std::initializer_list<const char*> names);

// Returns the named member if it is an object, else null.
const Json* object_in(const Json& json, const char* name);

// Returns the relative file name in a URI, with escapes (%20) decoded. Returns nothing if the name may lead
// out of the folder: an absolute path, a scheme such as http:, or a part '..'.
std::optional<std::string> name_in_uri(std::string_view uri);

// Returns the transform of a node relative to its parent; nothing if the node's numbers are invalid.
std::optional<Eigen::Affine3d> transform_of(const Json& node);

// Returns the transform of each of `count` vertices with these attributes: the weighted sum of its joints'
// transforms. Returns no transforms if there are no joints or weights. Errors: kind input, at `place`.
Result<std::vector<Eigen::Affine3d>> skinned_transforms(const Source& source, GltfFile& file,
                                                        std::size_t skin, const Json& attributes,
                                                        std::size_t count, const std::string& place);

class GltfTextures {
 public:
  // Reads the base colour textures of all materials. `file` must outlive the object.
  explicit GltfTextures(GltfFile& file);

  // Returns whether any texture can be read. If not, materials have no effect on colours.
  bool has_any() const { return !textures_.empty(); }

  // Returns the colours of the `count` vertices of a primitive with these attributes.
  std::vector<Colour> colours(const Json& primitive, const Json& attributes, std::size_t count) const;

  // Returns remarks on textures that could not be read.
  const std::vector<std::string>& remarks() const { return remarks_; }

 private:
  void read_texture(std::size_t number);

  GltfFile& file_;
  std::map<std::size_t, Texture> textures_;  // by texture index
  std::vector<std::string> remarks_;
};

}  // namespace relievo::io
