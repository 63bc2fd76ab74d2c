// Reads STL, binary and ascii. A file has separate triangles; coincident corners are merged.
#include <algorithm>

#include "geometry/weld.h"
#include "io/formats.h"
#include "io/numbers.h"
#include "io/polygon.h"
#include "io/text.h"
#include "relievo/core/text.h"

namespace relievo::io {
namespace {

constexpr std::size_t header_size = 84, triangle_size = 50;

// Returns whether a file is binary. Some binary files begin with "solid" although the format forbids it, and
// some text files do not begin with it. A file is binary if its size follows from the number of triangles, or
// if it has a zero byte or another control character. In any binary file of less than 800 MB the number of
// triangles contains a zero byte.
bool is_binary(const Source& source) {
  const std::string_view bytes = source.bytes;
  if (bytes.size() < header_size) return has_control_bytes(bytes);
  const std::uint64_t promised = little<std::uint32_t>(bytes.data() + 80);
  return bytes.size() == header_size + promised * triangle_size || has_control_bytes(bytes);
}

// Collects the corners of single triangles and merges coincident ones.
class Corners {
 public:
  explicit Corners(std::size_t triangles)
      : table_(triangles / 2 + 3) {  // about the number of vertices of a closed mesh
    points_.reserve(triangles / 2 + 3);
    triangles_.reserve(triangles);
  }

  // Adds the corners corner(0), ..., corner(n - 1).
  template <typename Corner>
  void add(std::size_t n, const Corner& corner) {
    for_each_hashed(table_, n, corner, [&](std::size_t i, std::uint64_t hash) {
      const auto next = static_cast<Index>(points_.size());
      points_.push_back(corner(i));
      const Index number = table_.find_or_add(points_.back(), hash, points_.data(), next);
      if (number != next) points_.pop_back();
      open_[count_++ % 3] = number;
      if (count_ % 3 == 0) end_triangle();
    });
  }

  std::size_t count() const { return count_; }

  RawCloud take(std::string format) {
    RawCloud raw{Cloud{std::move(points_), {}}, std::move(format)};
    raw.mesh = mesh_over(raw.cloud, std::move(triangles_));
    return raw;
  }

 private:
  void end_triangle() {
    if (open_[0] != open_[1] && open_[1] != open_[2] && open_[2] != open_[0]) triangles_.push_back(open_);
  }

  PointTable table_;
  std::vector<Vec3> points_;
  std::vector<Triangle> triangles_;
  Triangle open_{};
  std::size_t count_ = 0;
};

Result<RawCloud> read_binary(const Source& source) {
  if (source.bytes.size() < header_size)
    return source.error_at_byte(
        0, cat("expected the 84 bytes of a binary STL header, found ", source.bytes.size()));
  const std::uint64_t promised = little<std::uint32_t>(source.bytes.data() + 80);
  const std::size_t room = (source.bytes.size() - header_size) / triangle_size;
  if (promised > room)
    return source.error_at_byte(
        80, cat("expected the number of triangles, found ", promised, ", and there is room for ", room));
  if (promised == 0) return source.error_at_byte(80, "expected at least one triangle, found 0");
  Corners corners(promised);
  const char* first = source.bytes.data() + header_size + 12;
  corners.add(3 * promised, [&](std::size_t i) {
    const char* at = first + i / 3 * triangle_size + i % 3 * 12;
    return Vec3(little<float>(at), little<float>(at + 4), little<float>(at + 8));
  });
  return corners.take("STL binary");
}

class AsciiReader {
 public:
  explicit AsciiReader(const Source& source) : lines_(source) {}

  Result<RawCloud> read() {
    while (const auto line = lines_.next()) {
      Words words(*line);
      for (auto keyword = words.next(); !keyword.empty(); keyword = words.next())
        RELIEVO_CHECK(take(keyword, words));
    }
    if (!has_end_ || corners_.count() % 3 != 0) return lines_.fail_at_end("endsolid");
    if (corners_.count() == 0)
      return lines_.fail("expected at least one facet with three vertices, found none");
    return corners_.take("STL ascii");
  }

 private:
  // Processes one statement. Line ends are ignored, because some programs write none.
  Result<void> take(std::string_view keyword, Words& words) {
    if (equals_ignoring_case(keyword, "vertex")) return take_vertex(words);
    if (equals_ignoring_case(keyword, "endfacet")) return end_facet();
    const bool is_end = equals_ignoring_case(keyword, "endsolid");
    has_end_ = has_end_ || is_end;
    if (is_end || equals_ignoring_case(keyword, "solid")) skip_name(words);
    if (equals_ignoring_case(keyword, "facet"))
      for (int i = 0; i < 4; ++i) words.next();  // skips "normal" and its numbers
    return {};
  }

  // Skips a solid's name, which extends to the first facet and may contain any words.
  static void skip_name(Words& words) {
    Words ahead = words;
    for (auto word = ahead.next(); !word.empty(); word = ahead.next()) {
      if (equals_ignoring_case(word, "facet") && equals_ignoring_case(Words(ahead).next(), "normal")) return;
      words = ahead;
    }
  }

  Result<void> take_vertex(Words& words) {
    Vec3 corner;
    for (double& value : corner) {
      const std::string_view word = words.next();
      const auto number = parse_number(word);
      if (!number) return lines_.fail("expected 3 numbers after vertex, found " + in_quotes(word));
      value = *number;
    }
    corners_.add(1, [&](std::size_t) { return corner; });
    return {};
  }

  Result<void> end_facet() const {
    if (corners_.count() % 3 == 0) return {};
    return lines_.fail(cat("expected 3 vertices in the facet, found ", corners_.count() % 3));
  }

  SourceLines lines_;
  Corners corners_{0};
  bool has_end_ = false;
};

bool is_ascii(std::string_view bytes) {
  bytes.remove_prefix(byte_order_mark_size(bytes));
  return equals_ignoring_case(Words(bytes.substr(0, 64)).next().substr(0, 5), "solid");
}

}  // namespace

// Binary STL has no magic number, but its size follows from the number of triangles.
bool is_stl(const Source& source) {
  if (is_ascii(source.bytes) || has_ending(source.name, ".stl")) return true;
  if (source.bytes.size() < header_size || !has_control_bytes(source.bytes)) return false;
  return source.bytes.size() ==
         header_size + triangle_size * std::uint64_t{little<std::uint32_t>(source.bytes.data() + 80)};
}

Result<RawCloud> read_stl(const Source& source) {
  return is_binary(source) ? read_binary(source) : AsciiReader(source).read();
}

}  // namespace relievo::io
