#include "io/gltf/meshopt.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "io/gltf/meshopt_reader.h"

namespace relievo::io {
namespace {

using Bytes = std::vector<std::byte>;

constexpr std::size_t group_size = 16;  // elements whose differences are stored alike
constexpr std::size_t most_stride = 256, attributes_tail = 32, triangles_tail = 16, indices_tail = 4;
constexpr unsigned char attributes_header = 0xA0, triangles_header = 0xE1, indices_header = 0xD1;

// Returns the bytes between the header and the tail; nothing if the header is another or the bytes are too few.
std::optional<std::string_view> body_of(std::string_view compressed, unsigned char header, std::size_t tail) {
  if (compressed.size() < 1 + tail || static_cast<unsigned char>(compressed[0]) != header)
    return std::nullopt;
  return compressed.substr(1, compressed.size() - 1 - tail);
}

// Reads the differences of a group: 0, 2, 4 or 8 bits each. All bits set mean that the difference follows in a byte.
std::array<std::uint8_t, group_size> next_differences(MeshoptBytes& from, unsigned mode) {
  std::array<std::uint8_t, group_size> differences{};
  if (mode == 0) return differences;
  const unsigned bits = 1U << mode, in_byte = 8 / bits, escape = (1U << bits) - 1;
  for (std::size_t i = 0; i < group_size; i += in_byte) {
    const unsigned packed = from.next();
    for (unsigned j = 0; j < in_byte; ++j)
      differences[i + j] = static_cast<std::uint8_t>(packed >> (8 - bits * (j + 1)) & escape);
  }
  if (mode == 3) return differences;
  for (std::uint8_t& difference : differences)
    if (difference == escape) difference = from.next();
  return differences;
}

// Decodes one byte of each of the elements of a block, beginning at `to`, which follow `last`.
void decode_column(MeshoptBytes& from, std::size_t elements, std::size_t stride, std::uint8_t& last,
                   std::byte* to) {
  const std::size_t groups = (elements + group_size - 1) / group_size;
  std::array<std::uint8_t, 4> modes{};  // of at most 16 groups, two bits each
  for (std::size_t i = 0; i < (groups + 3) / 4; ++i) modes[i] = from.next();
  for (std::size_t group = 0; group < groups; ++group) {
    const auto differences = next_differences(from, modes[group / 4] >> 2 * (group % 4) & 3U);
    const std::size_t first = group * group_size;
    for (std::size_t i = first; i < std::min(first + group_size, elements); ++i) {
      last = static_cast<std::uint8_t>(last + without_zigzag(differences[i - first]));
      to[i * stride] = static_cast<std::byte>(last);
    }
  }
}

std::optional<Bytes> decode_attributes(std::string_view compressed, const MeshoptLayout& layout) {
  const std::size_t stride = layout.stride;
  if (stride == 0 || stride % 4 != 0 || stride > most_stride) return std::nullopt;
  const auto body = body_of(compressed, attributes_header, std::max(stride, attributes_tail));
  // Two bits are the least that 16 elements take, for each of their bytes.
  if (!body || layout.count / (4 * group_size) > body->size() / stride) return std::nullopt;
  std::array<std::uint8_t, most_stride> last{};
  std::memcpy(last.data(), compressed.data() + compressed.size() - stride, stride);
  Bytes decoded(layout.count * stride);
  MeshoptBytes from(*body);
  const std::size_t block = std::min<std::size_t>(8192 / stride / group_size * group_size, 256);
  for (std::size_t first = 0; first < layout.count && !from.is_beyond(); first += block)
    for (std::size_t byte = 0; byte < stride; ++byte)
      decode_column(from, std::min(block, layout.count - first), stride, last[byte],
                    decoded.data() + first * stride + byte);
  return from.is_at_end() ? std::optional(std::move(decoded)) : std::nullopt;
}

// Returns the indices in `stride` bytes each.
Bytes in_bytes(const std::vector<std::uint32_t>& indices, std::size_t stride) {
  Bytes bytes(indices.size() * stride);
  for (std::size_t i = 0; i < indices.size(); ++i)
    for (std::size_t byte = 0; byte < stride; ++byte)
      bytes[i * stride + byte] = static_cast<std::byte>(indices[i] >> 8 * byte & 255);
  return bytes;
}

std::optional<Bytes> decode_triangles(std::string_view compressed, const MeshoptLayout& layout) {
  const auto body = body_of(compressed, triangles_header, triangles_tail);
  const std::size_t triangles = layout.count / 3;
  if (!body || layout.count % 3 != 0 || triangles > body->size()) return std::nullopt;
  std::vector<std::uint32_t> indices(layout.count);
  const bool is_decoded = decode_meshopt_triangles(
      MeshoptBytes(body->substr(0, triangles)), MeshoptBytes(body->substr(triangles)),
      compressed.substr(compressed.size() - triangles_tail), indices.data(), triangles);
  return is_decoded ? std::optional(in_bytes(indices, layout.stride)) : std::nullopt;
}

std::optional<Bytes> decode_indices(std::string_view compressed, const MeshoptLayout& layout) {
  const auto body = body_of(compressed, indices_header, indices_tail);
  if (!body || layout.count > body->size()) return std::nullopt;
  MeshoptBytes from(*body);
  std::array<std::uint32_t, 2> last{};  // the lowest bit says which of them a difference is to
  std::vector<std::uint32_t> indices(layout.count);
  for (std::uint32_t& index : indices) {
    const std::uint32_t number = from.next_number();
    index = last[number & 1] += without_zigzag(number >> 1);
  }
  return from.is_at_end() ? std::optional(in_bytes(indices, layout.stride)) : std::nullopt;
}

// Unfolds unit vectors from the octahedron, in place. The third number says what stands for 1, the fourth stays.
template <typename Integer>
bool unfold_octahedron(Bytes& bytes) {
  constexpr float most = std::numeric_limits<Integer>::max();
  for (std::size_t at = 0; at < bytes.size(); at += 4 * sizeof(Integer)) {
    std::array<Integer, 4> numbers;
    std::memcpy(numbers.data(), bytes.data() + at, sizeof numbers);
    if (numbers[2] <= 0) return false;
    const float one = numbers[2];
    float x = numbers[0] / one, y = numbers[1] / one;
    const float z = 1 - std::abs(x) - std::abs(y), fold = std::min(z, 0.F);
    x -= std::copysign(fold, x);
    y -= std::copysign(fold, y);
    const float scale = most / std::hypot(x, y, z);
    numbers[0] = static_cast<Integer>(std::lround(scale * x));
    numbers[1] = static_cast<Integer>(std::lround(scale * y));
    numbers[2] = static_cast<Integer>(std::lround(scale * z));
    std::memcpy(bytes.data() + at, numbers.data(), sizeof numbers);
  }
  return true;
}

// Makes floats of numbers with 8 bits of exponent and 24 bits of mantissa, both signed.
void expand_exponents(Bytes& bytes) {
  for (std::size_t at = 0; at + 4 <= bytes.size(); at += 4) {
    std::int32_t packed = 0;
    std::memcpy(&packed, bytes.data() + at, 4);
    const std::int32_t exponent = packed >> 24, mantissa = (packed ^ exponent * (1 << 24));
    const std::int32_t is_negative = mantissa >> 23 & 1;
    const float value = std::ldexp(static_cast<float>(mantissa - is_negative * (1 << 24)), exponent);
    std::memcpy(bytes.data() + at, &value, 4);
  }
}

bool apply(MeshoptFilter filter, std::size_t stride, Bytes& bytes) {
  if (filter == MeshoptFilter::exponential) expand_exponents(bytes);
  if (filter != MeshoptFilter::octahedral) return true;
  if (stride == 4) return unfold_octahedron<std::int8_t>(bytes);
  return stride == 8 && unfold_octahedron<std::int16_t>(bytes);
}

}  // namespace

std::optional<MeshoptMode> meshopt_mode(std::string_view name) {
  if (name == "ATTRIBUTES") return MeshoptMode::attributes;
  if (name == "TRIANGLES") return MeshoptMode::triangles;
  if (name == "INDICES") return MeshoptMode::indices;
  return std::nullopt;
}

std::optional<MeshoptFilter> meshopt_filter(std::string_view name) {
  if (name == "NONE") return MeshoptFilter::none;
  if (name == "OCTAHEDRAL") return MeshoptFilter::octahedral;
  if (name == "EXPONENTIAL") return MeshoptFilter::exponential;
  return std::nullopt;
}

std::optional<std::vector<std::byte>> decode_meshopt(std::string_view compressed,
                                                     const MeshoptLayout& layout) {
  if (layout.mode == MeshoptMode::attributes) {
    auto decoded = decode_attributes(compressed, layout);
    if (decoded && !apply(layout.filter, layout.stride, *decoded)) return std::nullopt;
    return decoded;
  }
  if (layout.filter != MeshoptFilter::none || (layout.stride != 2 && layout.stride != 4)) return std::nullopt;
  return layout.mode == MeshoptMode::triangles ? decode_triangles(compressed, layout)
                                               : decode_indices(compressed, layout);
}

}  // namespace relievo::io
