// The body of a PLY file: the rows of the vertices and the faces, ascii or binary.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "io/faces.h"
#include "io/ply_header.h"
#include "io/records.h"
#include "relievo/core/text.h"

namespace relievo::io {

// The properties of a vertex that are read: x y z; nx ny nz if all three exist; red green blue if all three
// exist.
struct VertexColumns {
  static constexpr std::size_t most = 9;
  std::array<bool, most> is_there = {};
  std::array<std::size_t, most> property = {};  // index of the property that is read into each column

  bool has_normals() const { return is_there[3]; }
  bool has_colours() const { return is_there[6]; }
};

// A file after its header has been read. Faces are read, whether they are before or after the vertices.
struct PlyBody {
  const Source& source;
  const PlyHeader& header;
  std::span<const PlyElement> before;
  const PlyElement& vertex;
  std::span<const PlyElement> after;
  VertexColumns columns;
};

struct PlyContent {
  Cloud cloud;
  std::vector<Triangle> triangles;
};

// Return the vertices and faces. Errors: kind input, with the place, for a body that ends early, a word that
// is not a number, and a face with a vertex that does not exist. Bytes after the faces are ignored.
Result<PlyContent> read_ascii_body(const PlyBody& body);
Result<PlyContent> read_binary_body(const PlyBody& body);

// Returns the rows of vertices without lists as records; their offset is left 0.
Records vertex_records(const PlyHeader& header, const PlyElement& vertex, const VertexColumns& columns);

// Returns a cloud of that many points, with normals and colours if `columns` has them.
Cloud sized_cloud(std::size_t points, const VertexColumns& columns);

// Returns the factor that scales colours of that type to [0, 255].
double colour_scale(NumberType type);

// The list property of a face element that contains the face's vertices.
struct FaceList {
  std::size_t property;
  FaceKind kind;
};
// Returns the list property of an element; nothing if it has none.
std::optional<FaceList> find_face_list(const PlyElement& element);

template <typename Rows>
Result<void> read_faces(const PlyElement& element, const FaceList& list, Rows& rows, PlyContent& content) {
  RELIEVO_CHECK(rows.begin(element));
  std::vector<std::int64_t> corners;
  for (std::uint64_t row = 0; row < element.count; ++row) {
    corners.clear();
    RELIEVO_CHECK(rows.read_face(element, list, corners));
    if (!add_face(corners, list.kind, content.cloud.points, content.triangles))
      return rows.fail(cat(expected_corners(corners, content.cloud.points), " in row ", row, " of element ",
                           printable(element.name)));
  }
  return {};
}

// Reads a body through `rows`, ascii or binary. Faces that precede the vertices are read after them.
template <typename Rows>
Result<PlyContent> read_elements(const PlyBody& body, Rows rows) {
  std::vector<std::pair<const PlyElement*, Rows>> early_faces;
  for (const PlyElement& element : body.before) {
    if (find_face_list(element)) early_faces.emplace_back(&element, rows);
    RELIEVO_CHECK(rows.skip(element));
  }
  PlyContent content;
  RELIEVO_CHECK(read_vertices(body, rows, content.cloud));
  for (auto& [element, at] : early_faces)
    RELIEVO_CHECK(read_faces(*element, *find_face_list(*element), at, content));
  for (const PlyElement& element : body.after) {
    const auto list = find_face_list(element);
    RELIEVO_CHECK(list ? read_faces(element, *list, rows, content) : rows.skip(element));
  }
  return content;
}

}  // namespace relievo::io
