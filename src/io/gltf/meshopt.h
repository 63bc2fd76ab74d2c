// Decodes buffer views that are compressed by the glTF extensions KHR_meshopt_compression and
// EXT_meshopt_compression. Appendices A and B of the former specify the format; it includes all of the
// latter. Tested by tests/io/meshopt_test.cpp.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace relievo::io {

enum class MeshoptMode { attributes, triangles, indices };

enum class MeshoptFilter { none, octahedral, exponential, colour };

// Describes how a view was compressed, as the JSON of the file states it. The view has `count` elements of
// `stride` bytes.
struct MeshoptLayout {
  MeshoptMode mode = MeshoptMode::attributes;
  MeshoptFilter filter = MeshoptFilter::none;
  std::size_t count = 0, stride = 0;
};

// Returns the mode or filter of that name in JSON; nothing if it is unknown. The filter QUATERNION is unknown
// here, because only animations use it.
std::optional<MeshoptMode> meshopt_mode(std::string_view name);
std::optional<MeshoptFilter> meshopt_filter(std::string_view name);

// Returns the count * stride bytes of a view. Nothing if the compressed bytes do not have that many elements,
// or if the extensions do not allow the layout. The memory taken is at most 1,024 times that of the
// compressed bytes.
std::optional<std::vector<std::byte>> decode_meshopt(std::string_view compressed,
                                                     const MeshoptLayout& layout);

}  // namespace relievo::io
