#include "io/ply.h"

#include <algorithm>
#include <utility>

#include "io/text.h"

namespace relievo::io {
namespace {

constexpr std::array<std::string_view, VertexColumns::most> column_names = {"x", "y", "z", "nx", "ny", "nz"};

// Number of the property with that name; the number of properties if there is none.
std::size_t find_property(const PlyElement& element, std::string_view name) {
  const auto& all = element.properties;
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const PlyProperty& p) { return p.name == name; });
  return static_cast<std::size_t>(found - all.begin());
}

std::string names_of(const PlyElement& element) {
  std::string names;
  for (const PlyProperty& p : element.properties) {
    if (names.size() > 60) return names + ", ...";
    names += (names.empty() ? "" : ", ") + printable(p.name);
  }
  return names.empty() ? "none" : names;
}

Result<VertexColumns> find_columns(const Source& source, const PlyElement& vertex) {
  VertexColumns columns;
  std::size_t found = 0;
  for (; found < VertexColumns::most; ++found) {
    const std::size_t i = find_property(vertex, column_names[found]);
    if (i == vertex.properties.size() || vertex.properties[i].is_list()) break;
    columns.property[found] = i;
  }
  if (found < 3) {
    return source.error_in_line(vertex.line, "expected element vertex to have a numeric property " +
                                                 std::string(column_names[found]) + ", found " +
                                                 names_of(vertex));
  }
  columns.count = found == VertexColumns::most ? VertexColumns::most : 3;
  return columns;
}

std::string format_name(PlyFormat format) {
  switch (format) {
    case PlyFormat::ascii:
      return "PLY ascii";
    case PlyFormat::little_endian:
      return "PLY binary little endian";
    case PlyFormat::big_endian:
      return "PLY binary big endian";
  }
  return {};
}

}  // namespace

Cloud sized_cloud(std::size_t points, const VertexColumns& columns) {
  Cloud cloud;
  cloud.points.resize(points);
  if (columns.count == VertexColumns::most) cloud.normals.resize(points);
  return cloud;
}

Result<RawCloud> read_ply(const Source& source) {
  const auto header = read_ply_header(source);
  if (!header) return std::unexpected(header.error());
  const auto& elements = header->elements;
  const auto vertex =
      std::find_if(elements.begin(), elements.end(), [](auto& e) { return e.name == "vertex"; });
  if (vertex == elements.end()) {
    return source.error_in_line(header->lines, "expected an element vertex before end_header, found none");
  }
  if (vertex->count >= no_index) {
    return source.error_in_line(
        vertex->line, "expected fewer than 4294967295 vertices, found " + std::to_string(vertex->count));
  }
  const auto columns = find_columns(source, *vertex);
  if (!columns) return std::unexpected(columns.error());
  const PlyBody body{source, *header, {elements.begin(), vertex}, *vertex, *columns};
  auto cloud = header->format == PlyFormat::ascii ? read_ascii_body(body) : read_binary_body(body);
  if (!cloud) return std::unexpected(std::move(cloud.error()));
  return RawCloud{std::move(*cloud), format_name(header->format)};
}

}  // namespace relievo::io
