// Decodes triangles compressed by EXT_meshopt_compression: mode 1 of its specification. A triangle is usually
// one byte, which selects an edge and a vertex among the most recent ones.
#include <array>

#include "io/gltf/meshopt_reader.h"

namespace relievo::io {
namespace {

using Index = std::uint32_t;

// The last 16 values; index 0 is the newest.
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

  // Decodes a triangle that consists of a recent edge and one vertex.
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

  // Decodes a triangle whose three corners are new, recent or explicit.
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
  std::string_view table_;  // frequent pairs of corners
  Index next_ = 0, last_ = 0;
  Recent<Edge> edges_;
  Recent<Index> vertices_;
};

}  // namespace

bool decode_meshopt_triangles(MeshoptBytes codes, MeshoptBytes data, std::string_view table,
                              std::uint32_t* indices, std::size_t triangles) {
  TriangleDecoder decoder(data, table);
  for (std::size_t i = 0; i < triangles; ++i) decoder.next(codes.next(), indices + 3 * i);
  return decoder.is_at_end();
}

}  // namespace relievo::io
