#include <algorithm>
#include <array>
#include <charconv>
#include <vector>

#include "io/formats.h"
#include "io/numbers.h"
#include "io/obj_textures.h"
#include "io/polygon.h"
#include "relievo/core/text.h"

namespace relievo::io {
namespace {

// A corner of a face; `normal` is no_index if the face has none.
struct Corner {
  Index vertex, normal;
};

class ObjReader {
 public:
  explicit ObjReader(const Source& source) : lines_(source) {}

  Result<RawCloud> read() {
    while (next_line()) {
      take_painted(line_);
      Words words(before_comment(line_));
      const std::string_view keyword = words.next();
      if (keyword == "v") RELIEVO_CHECK(take_vertex(words));
      if (keyword == "vn") RELIEVO_CHECK(take_vector(words, normals_));
      if (keyword == "f" || keyword == "fo") RELIEVO_CHECK(take_face(words));  // fo is an old name of f
      if (keyword == "vt") textures_.take_coordinates(words);
      if (keyword == "mtllib") textures_.take_libraries(rest_of(keyword));
      if (keyword == "usemtl") textures_.take_material(rest_of(keyword));
      const bool is_curve = keyword == "curv" || keyword == "curv2" || keyword == "surf";
      if (is_curve && curves_++ == 0) first_curve_line_ = first_line_;
    }
    if (points_.empty()) return lines_.fail_at_end("lines 'v x y z'");
    // The points of a file that has only curves are control points, and need not lie on the curves.
    if (curves_ > 0 && corners_.empty())
      return lines_.source().error_in_line(first_curve_line_,
                                           "expected faces, found curves or surfaces, which are not read; "
                                           "the CAD program that made them exports triangles, too");
    RELIEVO_CHECK(check_vertices());
    if (behind_weights_.size() == colours_.size()) colours_ = std::move(behind_weights_);
    if (colours_.empty()) colours_ = std::move(painted_);
    forget_missing_normals();
    std::vector<Vec3f> normals = point_normals();
    RawCloud raw{Cloud{std::move(points_), std::move(normals)}, "OBJ"};
    add_colours(raw);
    add_mesh(raw);
    if (curves_ > 0)
      raw.remarks.push_back(
          cat("left out ", curves_, " curves and surfaces (curv, surf), which are not read"));
    return raw;
  }

 private:
  // Reads the next line. A line that ends with a backslash is joined with the following line.
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

  // Returns the line without its keyword. The rest is a name that may contain blanks.
  std::string_view rest_of(std::string_view keyword) const {
    const std::string_view line = trim(before_comment(line_));
    return trim(line.substr(keyword.size()));
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

  // Reads a vertex, and the colour that may follow its coordinates. A single number after them is a weight.
  // If four numbers follow, the first is a weight if it is 1 in all vertices; otherwise the last is an
  // opacity.
  Result<void> take_vertex(Words& words) {
    RELIEVO_CHECK(take_vector(words, points_));
    std::array<float, 4> values = {};
    std::size_t count = 0;
    for (; count < values.size(); ++count) {
      const auto number = parse_number(words.next());
      if (!number) break;
      values[count] = static_cast<float>(*number);
    }
    if (count >= 3) colours_.emplace_back(values[0], values[1], values[2]);
    if (count == 4 && values[0] == 1) behind_weights_.emplace_back(values[1], values[2], values[3]);
    return {};
  }

  // Reads colours that ZBrush writes as comments: after '#MRGB ' two hexadecimal digits each for a mask, red,
  // green and blue of every vertex.
  void take_painted(std::string_view line) {
    constexpr std::string_view keyword = "#MRGB ";
    if (!line.starts_with(keyword)) return;
    for (line.remove_prefix(keyword.size()); line.size() >= 8; line.remove_prefix(8)) {
      std::uint32_t bits = 0;
      const auto [end, failed] = std::from_chars(line.data(), line.data() + 8, bits, 16);
      if (failed != std::errc() || end != line.data() + 8) return;
      painted_.push_back(Vec3f(static_cast<float>(bits >> 16 & 255), static_cast<float>(bits >> 8 & 255),
                               static_cast<float>(bits & 255)));
    }
  }

  Result<void> take_face(Words& words) {
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
      const std::size_t slash = std::min(word.find('/'), word.size());
      const auto vertex = resolve_obj_index(word.substr(0, slash), points_.size());
      if (!vertex) return fail("expected the number of a vertex, found " + in_quotes(word));
      if (*vertex > highest_vertex_) highest_vertex_ = *vertex, highest_line_ = first_line_;
      corners_.push_back({*vertex, no_index});
      if (*vertex < points_.size()) textures_.take_corner(*vertex, word.substr(slash));
      const std::size_t second = word.find('/', slash + 1);
      if (second >= word.size() - 1) continue;  // corners without normal: "1", "1/2" and "1/2/"
      const auto normal = resolve_obj_index(word.substr(second + 1), normals_.size());
      if (!normal) return fail("expected the number of a normal, found " + in_quotes(word));
      corners_.back().normal = *normal;
    }
    face_ends_.push_back(corners_.size());
    return {};
  }

  // Checks the corners' vertices after all lines have been read, because faces may precede their vertices.
  Result<void> check_vertices() const {
    if (corners_.empty() || highest_vertex_ < points_.size()) return {};
    return lines_.source().error_in_line(
        highest_line_, cat("expected an index up to ", points_.size(), ", the number of vertices, found ",
                           highest_vertex_ + std::size_t{1}));
  }

  // Removes references to normals that the file lacks; some programs write such references. The geometry is
  // complete without normals.
  void forget_missing_normals() {
    for (Corner& c : corners_)
      if (c.normal != no_index && c.normal >= normals_.size()) c.normal = no_index;
  }

  // Returns one normal per point: the mean of the normals of all face corners at this point. If no corner has
  // a normal, point i gets the file's normal i, provided that the numbers of normals and points are equal;
  // otherwise there are no normals.
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

  void add_colours(RawCloud& raw) const {
    if (colours_.size() == raw.cloud.size())
      raw.cloud.colours = colours_in_bytes(colours_);
    else if (!colours_.empty())
      raw.remarks.push_back(cat("left out the colours, which only ", colours_.size(), " of ",
                                raw.cloud.size(), " vertices have"));
    if (!raw.cloud.has_colours()) textures_.add_colours(lines_.source(), raw);
  }

  // Adds the triangles of the faces. If the cloud has normals, corners without normal get the normal of their
  // point.
  void add_mesh(RawCloud& raw) const {
    std::size_t begin = 0;
    std::vector<Vec3> polygon;  // outside the loop to reuse its memory
    for (const std::size_t end : face_ends_) {
      add_face_of(std::span(corners_).subspan(begin, end - begin), polygon, raw);
      begin = end;
    }
    if (raw.mesh.triangles.empty()) return;
    raw.mesh.points = raw.cloud.points;
    raw.mesh.colours = raw.cloud.colours;
    for (Vec3& point : raw.mesh.points)
      if (!point.allFinite()) point = Vec3::Zero();  // no triangle uses this point
  }

  void add_face_of(std::span<const Corner> corners, std::vector<Vec3>& polygon, RawCloud& raw) const {
    polygon.clear();
    for (const Corner& c : corners) polygon.push_back(raw.cloud.points[c.vertex]);
    for_each_triangle(polygon, [&](Index a, Index b, Index c) {
      const Corner &p = corners[a], &q = corners[b], &r = corners[c];
      const bool is_finite = polygon[a].allFinite() && polygon[b].allFinite() && polygon[c].allFinite();
      if (!is_finite || p.vertex == q.vertex || q.vertex == r.vertex || r.vertex == p.vertex) return;
      raw.mesh.triangles.push_back({p.vertex, q.vertex, r.vertex});
      if (raw.cloud.has_normals())
        raw.mesh.corner_normals.push_back({normal_of(p, raw), normal_of(q, raw), normal_of(r, raw)});
    });
  }

  Vec3f normal_of(const Corner& c, const RawCloud& raw) const {
    return c.normal != no_index ? unit_normal(normals_[c.normal]) : raw.cloud.normals[c.vertex];
  }

  Result<void> fail(std::string expected) const {
    return lines_.source().error_in_line(first_line_, std::move(expected));
  }

  SourceLines lines_;
  std::string_view line_;
  std::string joined_;
  std::size_t first_line_ = 0;  // number of the first line of the text in line_
  std::vector<Vec3> points_, normals_;
  ObjTextures textures_;
  // Colours of vertices: `colours_` follow the coordinates, `behind_weights_` follow a weight of 1, and
  // `painted_` are in comments.
  std::vector<Vec3f> colours_, behind_weights_, painted_;
  std::size_t curves_ = 0, first_curve_line_ = 0;
  std::vector<Corner> corners_;         // corners of all faces, one face after the other
  std::vector<std::size_t> face_ends_;  // per face: index after its last corner
  Index highest_vertex_ = 0;            // highest index of a vertex in a face
  std::size_t highest_line_ = 0;        // line of the face with that index
};

}  // namespace

// Recognises a text by the first words of its lines, because only few words can begin a line of OBJ.
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
