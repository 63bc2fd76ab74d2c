#include "io/ply.h"

#include <algorithm>
#include <utility>

#include "io/formats.h"
#include "io/text.h"

namespace relievo::io {
namespace {

constexpr std::array<std::string_view, VertexColumns::most> column_names = {
    "x",       "y",       "z",       "nx",      "ny",    "nz",    "red",   "green", "blue",
    "opacity", "scale_0", "scale_1", "scale_2", "rot_0", "rot_1", "rot_2", "rot_3"};

// The properties of Gaussian splats that determine their colours.
constexpr std::array<std::string_view, 3> harmonic_names = {"f_dc_0", "f_dc_1", "f_dc_2"};

// Returns the index of the property with that name. If there is none, upper and lower case count as equal. If
// there is still none, returns the number of properties.
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

bool is_number(const PlyElement& element, std::size_t property) {
  return property < element.properties.size() && !element.properties[property].is_list();
}

// If the vertices are Gaussian splats without other colours, uses f_dc as their colours. If they are not
// splats, ignores their opacity, because its meaning is unknown.
void take_splat(const PlyElement& vertex, VertexColumns& columns) {
  std::array<std::size_t, harmonic_names.size()> places = {};
  std::ranges::transform(harmonic_names, places.begin(),
                         [&](auto name) { return find_property(vertex, name); });
  const std::span splat = std::span(columns.is_there).subspan(9);
  // Splats have opacity, three scales and a rotation, from column 9 on. Flat splats lack scale_2, column 12.
  const bool is_splat =
      std::ranges::count(splat, false) <= (columns.is_there[12] ? 0 : 1) && !has_lists(vertex) &&
      std::ranges::all_of(places, [&](std::size_t place) { return is_number(vertex, place); });
  if (!is_splat) std::ranges::fill(splat, false);
  if (!columns.has_opacity() || columns.has_colours()) return;
  columns.are_colours_harmonics = true;
  for (std::size_t c = 0; c < 3; ++c) {
    columns.is_there[6 + c] = true;
    columns.property[6 + c] = places[c];
  }
}

// Normals and colours are read only if all three of their properties exist.
Result<VertexColumns> find_columns(const Source& source, const PlyElement& vertex) {
  VertexColumns columns;
  columns.keeps_faint = source.keeps_doubtful;
  for (std::size_t c = 0; c < VertexColumns::most; ++c) {
    columns.property[c] = find_property(vertex, column_names[c]);
    columns.is_there[c] = is_number(vertex, columns.property[c]);
    if (c < 3 && !columns.is_there[c] && find_property(vertex, "packed_position") < vertex.properties.size())
      return source.error_in_line(vertex.line,
                                  "expected splats that are not packed, found those of a compressed PLY; "
                                  "SuperSplat opens it and exports a PLY that is not compressed");
    if (c < 3 && !columns.is_there[c])
      return source.error_in_line(vertex.line, "expected element vertex to have a numeric property " +
                                                   std::string(column_names[c]) + ", found " +
                                                   names_of(vertex));
  }
  for (std::size_t first = 3; first < 9; first += 3) {
    auto& there = columns.is_there;
    const bool is_whole = there[first] && there[first + 1] && there[first + 2];
    there[first] = there[first + 1] = there[first + 2] = is_whole;
  }
  take_splat(vertex, columns);
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

// Returns the location of a column in the rows of vertices, which have no lists.
RecordColumn column_of(const PlyElement& vertex, const VertexColumns& wanted, std::size_t c) {
  const auto& properties = vertex.properties;
  const NumberType type = properties[wanted.property[c]].type;
  RecordColumn found = c >= 6 && c < 9 ? colour_column(wanted, type) : RecordColumn{type};
  for (std::size_t i = 0; i < wanted.property[c]; ++i) found.at += size_in_bytes(properties[i].type);
  return found;
}

// Adds the parts of Gaussian splats that points do not have: opacity, scales and rotation.
void add_splats(const PlyElement& vertex, const VertexColumns& wanted, Records& records) {
  std::array<RecordColumn, VertexColumns::most> columns;
  for (std::size_t c = 9; c < columns.size(); ++c)
    if (wanted.is_there[c]) columns[c] = column_of(vertex, wanted, c);
  const auto number = [columns, is_big_endian = records.is_big_endian](const char* row, std::size_t c) {
    double value = 0;
    decoder(columns[c].type, is_big_endian)(row + columns[c].at, 0, 1, &value);
    return value;
  };
  records.axis = [number, has_depth = wanted.is_there[12]](const char* row) {
    const double depth = has_depth ? number(row, 12) : no_depth;
    return splat_axis(Vec3(number(row, 10), number(row, 11), depth),
                      {number(row, 13), number(row, 14), number(row, 15), number(row, 16)});
  };
  if (wanted.keeps_faint) return;
  records.left_out =
      LeftOutRows{[number](const char* row) { return is_faint(number(row, 9)); }, what_splats_leave_out};
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
  const auto columns = [&](std::size_t c) {
    return std::array{column_of(vertex, wanted, c), column_of(vertex, wanted, c + 1),
                      column_of(vertex, wanted, c + 2)};
  };
  records.position = columns(0);
  if (wanted.has_normals()) records.normal = columns(3);
  if (wanted.has_colours()) records.colour = columns(6);
  if (wanted.has_opacity()) add_splats(vertex, wanted, records);
  return records;
}

RecordColumn colour_column(const VertexColumns& columns, NumberType type) {
  constexpr double harmonic = 0.28209479177387814;  // the spherical harmonic of degree 0: 1 / (2 sqrt(pi))
  if (columns.are_colours_harmonics) return {type, 0, 255 * harmonic, 127.5};
  if (type == NumberType::float32 || type == NumberType::float64) return {type, 0, 255};
  return {type, 0, type == NumberType::uint16 ? 1 / 257.0 : 1};
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
  // Most programs that train splats write zeros as normals.
  if (columns.has_opacity() &&
      std::ranges::all_of(content.cloud.normals, [](const Vec3f& n) { return n.isZero(0); }))
    content.cloud.normals.clear();
  if (content.cloud.has_normals()) content.cloud.axes.clear();
  Mesh mesh = mesh_over(content.cloud, std::move(content.triangles));
  RawCloud raw{std::move(content.cloud), to_string(header.format), std::move(mesh)};
  if (columns.has_opacity()) raw.format += ", Gaussian splats";
  raw.leave_out(content.faint, what_splats_leave_out);
  return raw;
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
  if (columns.has_opacity()) records.normal.reset();  // most splats have zeros as normals
  records.axis = nullptr;                             // axes have no signs, so they have no mean
  std::uint64_t faces = 0;
  for (const PlyElement& element : elements)
    if (find_face_list(element)) faces += element.count;
  return StreamRecords{records, to_string(header.format), faces};
}

}  // namespace relievo::io
