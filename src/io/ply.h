// The body of a PLY file: the rows of the vertices and the faces, ascii or binary.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "io/faces.h"
#include "io/ply_header.h"
#include "io/records.h"

namespace relievo::io {

// What is wanted of a vertex: x y z; nx ny nz if all are there; red green blue if all are.
struct VertexColumns {
  static constexpr std::size_t most = 9;
  std::array<bool, most> is_there = {};
  std::array<std::size_t, most> property = {};  // number of the property of each column that is there

  bool has_normals() const { return is_there[3]; }
  bool has_colours() const { return is_there[6]; }
};

struct PlyBody {
  const Source& source;
  const PlyHeader& header;
  std::span<const PlyElement> before;  // elements to skip
  const PlyElement& vertex;
  std::span<const PlyElement> after;  // faces among them are read
  VertexColumns columns;
};

struct PlyContent {
  Cloud cloud;
  std::vector<Triangle> triangles;
};

// Return the vertices and faces. A body that ends early, has a word that is no number or a face with a vertex
// that does not exist is an error that names the place; what follows the faces is not looked at.
Result<PlyContent> read_ascii_body(const PlyBody& body);
Result<PlyContent> read_binary_body(const PlyBody& body);

// Returns the rows of vertices without lists as records, apart from where they begin.
Records vertex_records(const PlyHeader& header, const PlyElement& vertex, const VertexColumns& columns);

// The same for all columns that are wanted. Errors: kind input where there are no x, y and z.
Result<Records> ply_vertex_records(const Source& source, const PlyHeader& header, const PlyElement& vertex);

// Returns a cloud of that many points, with room for what `columns` has.
Cloud sized_cloud(std::size_t points, const VertexColumns& columns);

// Factor that takes colours of that type to [0, 255].
double colour_scale(NumberType type);

// How the list property of a face element is to be understood; nothing if it has no list of vertices.
struct FaceList {
  std::size_t property;
  FaceKind kind;
};
std::optional<FaceList> find_face_list(const PlyElement& element);

}  // namespace relievo::io
