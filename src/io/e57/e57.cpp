// Reads E57 1.0 (ASTM E2807-11): the points of all scans, each moved by its pose. Pictures and intensities
// are not read.
#include <algorithm>
#include <cmath>

#include "io/e57/e57_scan.h"
#include "io/formats.h"
#include "relievo/core/parallel.h"
#include "relievo/core/text.h"

namespace relievo::io {
namespace {

Vec3 triple_at(const E57Scan& scan, const E57Scan::Triple& triple, std::size_t row) {
  return {scan.columns[triple[0]].value(row), scan.columns[triple[1]].value(row),
          scan.columns[triple[2]].value(row)};
}

Vec3 position_at(const E57Scan& scan, std::size_t row) {
  const Vec3 p = triple_at(scan, scan.position, row);
  if (!scan.is_spherical) return p;
  return p[0] * Vec3(std::cos(p[2]) * std::cos(p[1]), std::cos(p[2]) * std::sin(p[1]), std::sin(p[2]));
}

// Scales colours that are stored as floats. Integer colours are already scaled.
std::uint8_t as_byte(const PackedColumn& column, std::size_t row) {
  double value = column.value(row);
  if (column.kind != PackedColumn::Kind::integer) value = column.scale * value + column.shift;
  return io::as_byte(value);
}

void decode_rows(const E57Scan& scan, std::size_t begin, std::size_t end, Cloud& cloud, std::size_t first) {
  const Mat3 turn = scan.turn.toRotationMatrix();
  for (std::size_t row = begin; row < end; ++row) {
    const bool is_valid = !scan.invalid || scan.columns[*scan.invalid].value(row) == 0;
    cloud.points[first + row] = is_valid ? Vec3(turn * position_at(scan, row) + scan.origin)
                                         : Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
    if (cloud.has_normals())
      cloud.normals[first + row] = unit_normal(turn * triple_at(scan, *scan.normal, row));
    if (!cloud.has_colours()) continue;
    for (std::size_t c = 0; c < 3; ++c)
      cloud.colours[first + row][c] = as_byte(scan.columns[(*scan.colour)[c]], row);
  }
}

Result<std::vector<E57Scan>> parse_scans(const Source& source, const E57Pages& pages) {
  RELIEVO_TRY(const XmlElements elements, parse_xml(pages.xml, source));
  std::vector<E57Scan> scans;
  const std::size_t all = find_child(elements, 0, "data3D");
  for (std::size_t i = all + 1; all != 0 && i < elements[all].end; i = elements[i].end) {
    RELIEVO_TRY(E57Scan scan, parse_e57_scan(source, elements, i));
    if (scan.section.rows > 0) scans.push_back(std::move(scan));
  }
  return scans;
}

}  // namespace

bool is_e57(const Source& source) {
  return source.bytes.starts_with("ASTM-E57") || has_ending(source.name, ".e57");
}

Result<RawCloud> read_e57(const Source& source) {
  E57Pages pages;
  RELIEVO_CHECK(read_e57_pages(source, pages));
  RELIEVO_TRY(std::vector<E57Scan> scans, parse_scans(source, pages));
  RawCloud raw;
  raw.format = cat("E57, ", scans.size(), scans.size() == 1 ? " scan" : " scans");
  const bool has_normals = std::ranges::all_of(scans, [](const E57Scan& s) { return s.normal.has_value(); });
  const bool has_colours = std::ranges::all_of(scans, [](const E57Scan& s) { return s.colour.has_value(); });
  for (E57Scan& scan : scans) {
    RELIEVO_CHECK(read_packed_columns(source, pages, scan.section, scan.columns));
    const std::size_t first = raw.cloud.size(), rows = scan.section.rows;
    if (rows >= no_index - first)
      return source.error({}, cat("expected fewer than ", no_index, " points, found ", first + rows));
    raw.cloud.points.resize(first + rows);
    if (has_normals) raw.cloud.normals.resize(first + rows);
    if (has_colours) raw.cloud.colours.resize(first + rows);
    parallel_ranges(rows, default_grain, [&](std::size_t begin, std::size_t end) {
      decode_rows(scan, begin, end, raw.cloud, first);
    });
    scan.columns.clear();
  }
  return raw;
}

}  // namespace relievo::io
