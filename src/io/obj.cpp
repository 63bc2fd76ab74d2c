#include <algorithm>
#include <array>
#include <vector>

#include "io/faces.h"
#include "io/formats.h"
#include "io/text.h"

namespace relievo::io {
namespace {

// A corner of a face; `normal` is no_index if the face names none.
struct Corner {
  Index vertex, normal;
};

// The highest index that a face has used, and its line, to be checked at the end: faces may precede their
// vertices.
struct Highest {
  std::int64_t index = 0;  // counted from 1, 0 for none
  std::size_t line = 0;
};

class ObjReader {
 public:
  explicit ObjReader(const Source& source)
      : source_(source), lines_(source.bytes, byte_order_mark_size(source.bytes)) {}

  Result<RawCloud> read() {
    while (next_line()) {
      Words words(line_.substr(0, line_.find('#')));
      const std::string_view keyword = words.next();
      Result<void> taken;
      if (keyword == "v") taken = take_vector(words, points_);
      if (keyword == "vn") taken = take_vector(words, normals_);
      if (keyword == "f") taken = take_face(words);
      if (!taken) return std::unexpected(taken.error());
    }
    if (points_.empty()) {
      return source_.error_in_line(lines_.number() + 1,
                                   "expected lines 'v x y z', found the end of the file");
    }
    if (const auto checked = check(highest_vertex_, points_.size(), "vertices"); !checked) {
      return std::unexpected(checked.error());
    }
    if (const auto checked = check(highest_normal_, normals_.size(), "normals"); !checked) {
      return std::unexpected(checked.error());
    }
    std::vector<Vec3f> normals = point_normals();
    RawCloud raw{Cloud{std::move(points_), std::move(normals)}, "OBJ"};
    add_mesh(raw);
    return raw;
  }

 private:
  // Reads the next line, together with those that a backslash at its end continues.
  bool next_line() {
    const auto line = lines_.next();
    if (!line) return false;
    first_line_ = lines_.number();
    line_ = *line;
    if (!line_.ends_with('\\')) return true;
    joined_ = line_;
    while (joined_.ends_with('\\')) {
      joined_.back() = ' ';
      joined_ += lines_.next().value_or("");
    }
    line_ = joined_;
    return true;
  }

  Result<void> take_vector(Words& words, std::vector<Vec3>& to) {
    Vec3 vector;
    for (double& value : vector) {
      const std::string_view word = words.next();
      const auto number = parse_number(word);
      if (!number)
        return fail("expected 3 numbers, found " + (word.empty() ? "the end of the line" : in_quotes(word)));
      value = *number;
    }
    to.push_back(vector);
    return {};
  }

  Result<void> take_face(Words& words) {
    const std::size_t first = corners_.size();
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
      const std::size_t slash = std::min(word.find('/'), word.size());
      const auto vertex = resolve(word.substr(0, slash), points_.size(), highest_vertex_);
      if (!vertex) return fail("expected the number of a vertex, found " + in_quotes(word));
      const std::size_t second = word.find('/', slash + 1);
      if (second == std::string_view::npos) {
        corners_.push_back({*vertex, no_index});
        continue;
      }
      const auto normal = resolve(word.substr(second + 1), normals_.size(), highest_normal_);
      if (!normal) return fail("expected the number of a normal, found " + in_quotes(word));
      corners_.push_back({*vertex, *normal});
    }
    for (std::size_t i = first + 2; i < corners_.size(); ++i)
      fans_.push_back({static_cast<Index>(first), static_cast<Index>(i - 1), static_cast<Index>(i)});
    return {};
  }

  // Converts an index counted from 1, or backwards from -1, to one counted from 0.
  std::optional<Index> resolve(std::string_view word, std::size_t defined, Highest& highest) {
    std::int64_t index = parse_integer(word).value_or(0);
    if (index < 0) index += static_cast<std::int64_t>(defined) + 1;
    if (index <= 0 || index >= no_index) return std::nullopt;
    if (index > highest.index) highest = {index, first_line_};
    return static_cast<Index>(index - 1);
  }

  Result<void> check(const Highest& highest, std::size_t defined, std::string_view what) const {
    if (highest.index <= static_cast<std::int64_t>(defined)) return {};
    return source_.error_in_line(highest.line, "expected an index up to " + std::to_string(defined) +
                                                   ", the number of " + std::string(what) + ", found " +
                                                   std::to_string(highest.index));
  }

  // Returns one normal per point, or none at all: the mean of those that faces name for a vertex.
  std::vector<Vec3f> point_normals() const {
    const bool has_named =
        std::ranges::any_of(corners_, [](const Corner& c) { return c.normal != no_index; });
    std::vector<Vec3> sums(has_named ? points_.size() : 0, Vec3::Zero());
    for (const Corner& c : corners_)
      if (c.normal != no_index) sums[c.vertex] += unit_normal(normals_[c.normal]).cast<double>();
    if (!has_named && normals_.size() == points_.size()) sums = normals_;
    std::vector<Vec3f> units(sums.size());
    std::transform(sums.begin(), sums.end(), units.begin(), unit_normal);
    return units;
  }

  // Returns the triangles of the faces; corners without a normal get none.
  void add_mesh(RawCloud& raw) const {
    const auto normal_of = [&](const Corner& c) -> Vec3f {
      if (c.normal != no_index) return unit_normal(normals_[c.normal]);
      return raw.cloud.has_normals() ? raw.cloud.normals[c.vertex] : Vec3f(Vec3f::Zero());
    };
    for (const auto& [a, b, c] : fans_) {
      const Corner &p = corners_[a], &q = corners_[b], &r = corners_[c];
      const bool is_finite = raw.cloud.points[p.vertex].allFinite() &&
                             raw.cloud.points[q.vertex].allFinite() && raw.cloud.points[r.vertex].allFinite();
      if (!is_finite || p.vertex == q.vertex || q.vertex == r.vertex || r.vertex == p.vertex) continue;
      raw.mesh.triangles.push_back({p.vertex, q.vertex, r.vertex});
      if (raw.cloud.has_normals())
        raw.mesh.corner_normals.push_back({normal_of(p), normal_of(q), normal_of(r)});
    }
    if (raw.mesh.triangles.empty()) return;
    raw.mesh.points = raw.cloud.points;
    for (Vec3& point : raw.mesh.points)
      if (!point.allFinite()) point = Vec3::Zero();  // no triangle uses it
  }

  Result<void> fail(std::string expected) const {
    return source_.error_in_line(first_line_, std::move(expected));
  }

  const Source& source_;
  Lines lines_;
  std::string_view line_;
  std::string joined_;
  std::size_t first_line_ = 0;  // where line_ begins
  std::vector<Vec3> points_, normals_;
  std::vector<Corner> corners_;
  std::vector<Triangle> fans_;  // indices of corners
  Highest highest_vertex_, highest_normal_;
};

}  // namespace

// Recognises text whose first word is one with which lines of OBJ begin.
bool is_obj(const Source& source) {
  if (!foreign_format(source).empty()) return false;
  if (has_ending(source.name, ".obj")) return true;

  const std::array<std::string_view, 8> keywords = {"v", "vn", "vt", "f", "o", "g", "mtllib", "usemtl"};
  Lines lines(source.bytes, byte_order_mark_size(source.bytes));
  while (const auto line = lines.next()) {
    const std::string_view word = Words(*line).next();
    if (word.empty() || word.starts_with('#')) continue;
    return std::find(keywords.begin(), keywords.end(), word) != keywords.end();
  }
  return false;
}

Result<RawCloud> read_obj(const Source& source) {
  return ObjReader(source).read();
}

}  // namespace relievo::io
