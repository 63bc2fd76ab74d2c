#include "io/ply.h"

#include <algorithm>
#include <utility>

#include "io/formats.h"
#include "io/text.h"

namespace relievo::io {
namespace {

constexpr std::array<std::string_view, VertexColumns::most> column_names = {"x",  "y",   "z",     "nx",  "ny",
                                                                            "nz", "red", "green", "blue"};

// Returns the index of the property with that name, or else with that name in upper or lower case, such as X;
// the number of properties if there is none.
std::size_t find_property(const PlyElement& element, std::string_view name) {
  const auto& all = element.properties;
  auto found = std::ranges::find(all, name, &PlyProperty::name);
  if (found == all.end())
    found =
        std::ranges::find_if(all, [&](const PlyProperty& p) { return equals_ignoring_case(p.name, name); });
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

// Normals and colours are read only if all three of their properties exist.
Result<VertexColumns> find_columns(const Source& source, const PlyElement& vertex) {
  VertexColumns columns;
  for (std::size_t c = 0; c < VertexColumns::most; ++c) {
    columns.property[c] = find_property(vertex, column_names[c]);
    columns.is_there[c] =
        columns.property[c] < vertex.properties.size() && !vertex.properties[columns.property[c]].is_list();
    if (c < 3 && !columns.is_there[c]) {
      return source.error_in_line(vertex.line, "expected element vertex to have a numeric property " +
                                                   std::string(column_names[c]) + ", found " +
                                                   names_of(vertex));
    }
  }
  for (std::size_t first = 3; first < VertexColumns::most; first += 3) {
    auto& there = columns.is_there;
    const bool is_whole = there[first] && there[first + 1] && there[first + 2];
    there[first] = there[first + 1] = there[first + 2] = is_whole;
  }
  return columns;
}

std::string to_string(PlyFormat format) {
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

Result<std::vector<PlyElement>::const_iterator> find_vertex(const Source& source, const PlyHeader& header) {
  const auto found = std::ranges::find(header.elements, std::string_view("vertex"), &PlyElement::name);
  if (found != header.elements.end()) return found;
  return source.error_in_line(header.lines, "expected an element vertex before end_header, found none");
}

}  // namespace

bool is_ply(const Source& source) {
  const std::string_view text = source.bytes.substr(byte_order_mark_size(source.bytes)), magic = "ply";
  if (!text.starts_with(magic)) return false;
  return text.size() == magic.size() ||
         std::string_view(" \t\r\n").find(text[magic.size()]) != std::string_view::npos;
}

Records vertex_records(const PlyHeader& header, const PlyElement& vertex, const VertexColumns& wanted) {
  Records records;
  records.count = vertex.count;
  records.stride = least_row_size(vertex);
  records.is_big_endian = header.format == PlyFormat::big_endian;
  const auto column = [&](std::size_t c) {
    const auto& properties = vertex.properties;
    RecordColumn found{properties[wanted.property[c]].type, 0};
    for (std::size_t i = 0; i < wanted.property[c]; ++i) found.at += size_in_bytes(properties[i].type);
    if (c >= 6) found.scale = colour_scale(found.type);
    return found;
  };
  const auto columns = [&](std::size_t c) { return std::array{column(c), column(c + 1), column(c + 2)}; };
  records.position = columns(0);
  if (wanted.has_normals()) records.normal = columns(3);
  if (wanted.has_colours()) records.colour = columns(6);
  return records;
}

double colour_scale(NumberType type) {
  if (type == NumberType::float32 || type == NumberType::float64) return 255;
  return type == NumberType::uint16 ? 1 / 257.0 : 1;
}

std::optional<FaceList> find_face_list(const PlyElement& element) {
  const bool is_strip = element.name == "tristrips";
  if (element.name != "face" && !is_strip) return std::nullopt;
  for (const std::string_view name : {"vertex_indices", "vertex_index"}) {
    const std::size_t i = find_property(element, name);
    if (i < element.properties.size() && element.properties[i].is_list())
      return FaceList{i, is_strip ? FaceKind::strip : FaceKind::polygon};
  }
  return std::nullopt;
}

Result<RawCloud> read_ply(const Source& source) {
  RELIEVO_TRY(const auto header, read_ply_header(source));
  const auto& elements = header.elements;
  RELIEVO_TRY(const auto vertex, find_vertex(source, header));
  if (vertex->count >= no_index)
    return source.error_in_line(vertex->line,
                                cat("expected fewer than 4294967295 vertices, found ", vertex->count));
  RELIEVO_TRY(const auto columns, find_columns(source, *vertex));
  const PlyBody body{source, header, {elements.begin(), vertex}, *vertex, {vertex + 1, elements.end()},
                     columns};
  RELIEVO_TRY(auto content,
              header.format == PlyFormat::ascii ? read_ascii_body(body) : read_binary_body(body));
  Mesh mesh = mesh_over(content.cloud, std::move(content.triangles));
  return RawCloud{std::move(content.cloud), to_string(header.format), std::move(mesh)};
}

Result<StreamRecords> find_ply_rows(const Source& head) {
  RELIEVO_TRY(const auto header, read_ply_header(head));
  const auto& elements = header.elements;
  RELIEVO_TRY(const auto vertex, find_vertex(head, header));
  if (header.format == PlyFormat::ascii || std::any_of(elements.begin(), vertex + 1, has_lists))
    return head.error_in_line(vertex->line,
                              "expected binary vertices without lists, to be read piece by piece");
  RELIEVO_TRY(const auto columns, find_columns(head, *vertex));
  Records records = vertex_records(header, *vertex, columns);
  records.offset = header.data_offset;
  for (auto element = elements.begin(); element != vertex; ++element) {
    const std::uint64_t size = least_row_size(*element);
    if (size > 0 && element->count > (std::uint64_t{1} << 60) / size)
      return head.error_in_line(element->line,
                                cat("expected a number of rows that fits the file, found ", element->count));
    records.offset += size * element->count;
  }
  std::uint64_t faces = 0;
  for (const PlyElement& element : elements)
    if (find_face_list(element)) faces += element.count;
  return StreamRecords{records, to_string(header.format), faces};
}

}  // namespace relievo::io
