// The body of a PLY file: the rows of the vertices, ascii or binary.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "io/ply_header.h"

namespace relievo::io {

// What is wanted of a vertex: x y z, and nx ny nz if all are there.
struct VertexColumns {
  static constexpr std::size_t most = 6;
  std::size_t count = 3;                        // of wanted columns, 3 or 6
  std::array<std::size_t, most> property = {};  // number of the property of each column
};

struct PlyBody {
  const Source& source;
  const PlyHeader& header;
  std::span<const PlyElement> before;  // elements to skip
  const PlyElement& vertex;
  VertexColumns columns;
};

// Return the vertices. A body that ends early or has a word that is no number is an error that names the
// place; what follows the vertices is not looked at.
Result<Cloud> read_ascii_body(const PlyBody& body);
Result<Cloud> read_binary_body(const PlyBody& body);

// Returns a cloud of that many points, with room for normals if `columns` has them.
Cloud sized_cloud(std::size_t points, const VertexColumns& columns);

}  // namespace relievo::io
