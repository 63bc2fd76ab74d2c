// Decodes buffer views that are compressed by the glTF extensions KHR_meshopt_compression and
// EXT_meshopt_compression. The format is specified in appendices A and B of KHR_meshopt_compression, which
// includes all of EXT_meshopt_compression.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace relievo::io {

// Reads compressed bytes one by one. Reading beyond the end returns zeros, and sets is_beyond().
class MeshoptBytes {
 public:
  explicit MeshoptBytes(std::string_view bytes) : bytes_(bytes) {}

  std::uint8_t next() {
    if (at_ < bytes_.size()) return static_cast<std::uint8_t>(bytes_[at_++]);
    is_beyond_ = true;
    return 0;
  }

  // Returns a number stored with seven bits per byte, lowest bits first (LEB128).
  std::uint32_t next_number() {
    std::uint32_t number = 0;
    for (unsigned shift = 0; shift < 35; shift += 7) {
      const std::uint32_t byte = next();
      number |= (byte & 127) << shift;
      if (byte < 128) return number;
    }
    is_beyond_ = true;
    return 0;
  }

  bool is_beyond() const { return is_beyond_; }

  // Returns whether exactly all bytes have been read.
  bool is_at_end() const { return at_ == bytes_.size() && !is_beyond_; }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
  bool is_beyond_ = false;
};

// Returns the signed number of a zigzag code: 0, 1, 2, 3, 4 represent 0, -1, 1, -2, 2. The result is modulo
// 2^8, 2^16 or 2^32.
template <typename Unsigned>
constexpr Unsigned without_zigzag(Unsigned stored) {
  const auto half = static_cast<Unsigned>(stored >> 1);
  return (stored & 1) != 0 ? static_cast<Unsigned>(~half) : half;
}

// Decodes `count` elements of `stride` bytes each. `stream` includes the header. Returns nothing if the
// stream does not contain that many elements.
std::optional<std::vector<std::byte>> decode_meshopt_attributes(std::string_view stream, std::size_t count,
                                                                std::size_t stride);

// Decodes three indices per triangle. `codes` has one byte per triangle, `table` 16 bytes, and `data` the
// remaining bytes. Returns false if `data` does not end exactly after the last triangle.
bool decode_meshopt_triangles(MeshoptBytes codes, MeshoptBytes data, std::string_view table,
                              std::uint32_t* indices, std::size_t triangles);

enum class MeshoptMode { attributes, triangles, indices };

enum class MeshoptFilter { none, octahedral, exponential, colour };

// The compression of a view, as the file's JSON states it. The view has `count` elements of `stride` bytes.
struct MeshoptLayout {
  MeshoptMode mode = MeshoptMode::attributes;
  MeshoptFilter filter = MeshoptFilter::none;
  std::size_t count = 0, stride = 0;
};

// Return the mode or filter with that name in JSON; nothing if it is unknown. The filter QUATERNION counts as
// unknown, because only animations use it.
std::optional<MeshoptMode> meshopt_mode(std::string_view name);
std::optional<MeshoptFilter> meshopt_filter(std::string_view name);

// Returns the count * stride bytes of a view. Returns nothing if the compressed bytes do not have that many
// elements, or if the extensions do not allow the layout. The memory needed is at most 1,024 times the size
// of the compressed bytes.
std::optional<std::vector<std::byte>> decode_meshopt(std::string_view compressed,
                                                     const MeshoptLayout& layout);

}  // namespace relievo::io
