#include "io/gltf/meshopt.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

namespace relievo::io {
namespace {

using Bytes = std::vector<std::byte>;

constexpr std::size_t triangles_tail = 16, indices_tail = 4;
constexpr unsigned char triangles_header = 0xE1, indices_header = 0xD1;

// Returns the bytes between the header and the tail; nothing if the header is wrong or there are too few
// bytes.
std::optional<std::string_view> body_of(std::string_view compressed, unsigned char header, std::size_t tail) {
  if (compressed.size() < 1 + tail || static_cast<unsigned char>(compressed[0]) != header)
    return std::nullopt;
  return compressed.substr(1, compressed.size() - 1 - tail);
}

// Returns the indices as bytes, `stride` bytes per index.
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
  std::array<std::uint32_t, 2> last{};  // two previous indices; the lowest bit of a number selects one
  std::vector<std::uint32_t> indices(layout.count);
  for (std::uint32_t& index : indices) {
    const std::uint32_t number = from.next_number();
    index = last[number & 1] += without_zigzag(number >> 1);
  }
  return from.is_at_end() ? std::optional(in_bytes(indices, layout.stride)) : std::nullopt;
}

// Decodes octahedron-encoded unit vectors in place. The third number of a vector represents 1; the fourth is
// not changed.
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

// Converts numbers with an exponent of 8 bits and a mantissa of 24 bits, both signed, to floats.
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

// Converts brightness, two colour differences and opacity to red, green, blue and opacity, in place. The
// highest set bit of the last number determines the number of bits of all four.
template <typename Integer>
bool mix_colours(Bytes& bytes) {
  using Signed = std::make_signed_t<Integer>;
  for (std::size_t at = 0; at < bytes.size(); at += 4 * sizeof(Integer)) {
    std::array<Integer, 4> numbers;
    std::memcpy(numbers.data(), bytes.data() + at, sizeof numbers);
    if (numbers[3] < 2) return false;
    const int most = static_cast<int>(std::bit_ceil(numbers[3] + 1U)) - 1, opacity = numbers[3] & most >> 1;
    const int y = numbers[0], orange = static_cast<Signed>(numbers[1]),
              green = static_cast<Signed>(numbers[2]);
    const std::array<int, 4> mixed = {y + orange - green, y + green, y - orange - green,
                                      2 * opacity | (opacity & 1)};
    for (std::size_t i = 0; i < mixed.size(); ++i)
      numbers[i] =
          static_cast<Integer>(std::lround(static_cast<float>(std::clamp(mixed[i], 0, most)) *
                                           std::numeric_limits<Integer>::max() / static_cast<float>(most)));
    std::memcpy(bytes.data() + at, numbers.data(), sizeof numbers);
  }
  return true;
}

bool apply(MeshoptFilter filter, std::size_t stride, Bytes& bytes) {
  switch (filter) {
    case MeshoptFilter::none:
      return true;
    case MeshoptFilter::exponential:
      expand_exponents(bytes);
      return true;
    case MeshoptFilter::octahedral:
      if (stride == 4) return unfold_octahedron<std::int8_t>(bytes);
      return stride == 8 && unfold_octahedron<std::int16_t>(bytes);
    case MeshoptFilter::colour:
      if (stride == 4) return mix_colours<std::uint8_t>(bytes);
      return stride == 8 && mix_colours<std::uint16_t>(bytes);
  }
  return false;
}

using Index = std::uint32_t;

// The last 16 values; index 0 is the newest one.
template <typename Value>
class Recent {
 public:
  const Value& operator[](std::size_t i) const { return values_[(newest_ - i) % values_.size()]; }
  void push(const Value& value) { values_[++newest_ % values_.size()] = value; }

 private:
  std::array<Value, 16> values_{};
  std::size_t newest_ = 16;
};

struct Edge {
  Index a = 0, b = 0;
};

// Decodes mode 1 of EXT_meshopt_compression. Most triangles take one byte, which selects a recent edge and a
// recent vertex.
class TriangleDecoder {
 public:
  TriangleDecoder(MeshoptBytes data, std::string_view table) : data_(data), table_(table) {}

  void next(unsigned code, Index* corners) {
    const unsigned high = code >> 4, low = code & 15;
    if (high < 15)
      follow_edge(high, low, corners);
    else
      take_three(low, corners);
  }

  bool is_at_end() const { return data_.is_at_end(); }

 private:
  Index explicit_index() { return last_ += without_zigzag(data_.next_number()); }

  // Decodes a triangle that consists of a recent edge and another vertex.
  void follow_edge(unsigned number, unsigned what, Index* corners) {
    const Edge edge = edges_[number];
    Index c = 0;
    if (what == 0)
      c = next_++;
    else if (what < 13)
      c = vertices_[what];
    else if (what < 15)
      c = last_ += what == 13 ? ~Index{0} : Index{1};  // the index before or after the last one
    else
      c = explicit_index();
    if (what == 0 || what >= 13) vertices_.push(c);
    edges_.push({c, edge.b});
    edges_.push({edge.a, c});
    corners[0] = edge.a, corners[1] = edge.b, corners[2] = c;
  }

  // Decodes a triangle from three corners that are new, recent or explicit.
  void take_three(unsigned what, Index* corners) {
    const bool is_in_table = what < 14;
    const unsigned pair = is_in_table ? static_cast<unsigned char>(table_[what]) : data_.next();
    const unsigned high = pair >> 4, low = pair & 15;
    if (!is_in_table && pair == 0) next_ = 0;
    const Index a = what == 15 ? explicit_index() : next_++;
    const Index b = corner(high), c = corner(low);
    edges_.push({b, a});
    edges_.push({c, b});
    edges_.push({a, c});
    vertices_.push(a);
    if (high == 0 || high == 15) vertices_.push(b);
    if (low == 0 || low == 15) vertices_.push(c);
    corners[0] = a, corners[1] = b, corners[2] = c;
  }

  Index corner(unsigned what) {
    if (what == 0) return next_++;
    return what < 15 ? vertices_[what - 1] : explicit_index();
  }

  MeshoptBytes data_;
  std::string_view table_;  // frequent pairs of corner codes
  Index next_ = 0, last_ = 0;
  Recent<Edge> edges_;
  Recent<Index> vertices_;
};

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
  if (name == "COLOR") return MeshoptFilter::colour;
  return std::nullopt;
}

std::optional<std::vector<std::byte>> decode_meshopt(std::string_view compressed,
                                                     const MeshoptLayout& layout) {
  if (layout.mode == MeshoptMode::attributes) {
    auto decoded = decode_meshopt_attributes(compressed, layout.count, layout.stride);
    if (decoded && !apply(layout.filter, layout.stride, *decoded)) return std::nullopt;
    return decoded;
  }
  if (layout.filter != MeshoptFilter::none || (layout.stride != 2 && layout.stride != 4)) return std::nullopt;
  return layout.mode == MeshoptMode::triangles ? decode_triangles(compressed, layout)
                                               : decode_indices(compressed, layout);
}

bool decode_meshopt_triangles(MeshoptBytes codes, MeshoptBytes data, std::string_view table,
                              std::uint32_t* indices, std::size_t triangles) {
  TriangleDecoder decoder(data, table);
  for (std::size_t i = 0; i < triangles; ++i) decoder.next(codes.next(), indices + 3 * i);
  return decoder.is_at_end();
}

}  // namespace relievo::io
