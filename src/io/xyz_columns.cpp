// Finds the columns of a text cloud that are coordinates, normals and colours.
#include <algorithm>
#include <cmath>
#include <string>

#include "io/xyz.h"

namespace relievo::io {
namespace {

using Row = std::vector<double>;

using Names = std::span<const std::string_view>;

// Names of coordinates in files of other programs, the most usual first: pairs of names for the plane, and
// single names for the height.
constexpr std::array<std::string_view, 18> plane_names = {
    "x",       "y",       "easting", "northing", "east",    "north",  "e",      "n",          "point_x",
    "point_y", "x_coord", "y_coord", "coord_x",  "coord_y", "xcoord", "ycoord", "rechtswert", "hochwert"};
constexpr std::array<std::string_view, 12> height_names = {"z",       "elevation", "height",      "altitude",
                                                           "elev",    "h",         "point_z",     "z_coord",
                                                           "coord_z", "zcoord",    "h\xC3\xB6he", "hoehe"};

constexpr std::array<std::string_view, 3> normal_names = {"nx", "ny", "nz"};

// Triples of names for red, green and blue in files of other programs.
constexpr std::array<std::string_view, 9> colour_names = {"r",    "g",  "b",  "red", "green",
                                                          "blue", "rf", "gf", "bf"};

// Classes of points in LAS go up to 31. Columns of whole numbers up to this value are regarded as classes or
// numbers of echoes.
constexpr double largest_class = 31;

std::size_t find_name(const ColumnNames& names, std::string_view wanted) {
  const auto found =
      std::ranges::find_if(names, [&](auto name) { return equals_ignoring_case(name, wanted); });
  return static_cast<std::size_t>(found - names.begin());
}

// Looks for a group of columns among the file's names. `spellings` is a list of groups of names; the first
// group that is complete in the file sets the columns. Returns false if there is none.
bool take_named(const ColumnNames& names, Names spellings, std::span<std::size_t> columns) {
  for (; !spellings.empty(); spellings = spellings.subspan(columns.size())) {
    for (std::size_t i = 0; i < columns.size(); ++i) columns[i] = find_name(names, spellings[i]);
    if (std::ranges::all_of(columns, [&](std::size_t column) { return column < names.size(); })) return true;
  }
  return false;
}

// Returns the line around a byte, or the part of the line within 1,000 bytes. Without that limit, a file of
// one long line would be searched once per sample.
std::string_view line_around(std::string_view data, std::size_t byte) {
  const std::size_t limit = 1000, first = byte - std::min(byte, limit);
  const std::string_view left = data.substr(first, byte - first), right = data.substr(byte, limit);
  const std::size_t begin = left.find_last_of("\r\n") + 1;  // npos + 1 is 0
  const std::size_t end = std::min(right.find_first_of("\r\n"), right.size());
  return data.substr(first + begin, byte + end - first - begin);
}

// Returns rows from all over the file as numbers, without rows that have a different number of columns. Words
// that are not numbers become NaN.
std::vector<Row> sample_rows(std::string_view data, const XyzLayout& layout) {
  const std::size_t samples = 256;
  std::vector<Row> rows;
  for (std::size_t i = 0; i < samples; ++i) {
    Row row;
    Fields fields(without_comment(line_around(data, data.size() * i / samples)), layout.separator);
    while (const auto field = fields.next())
      row.push_back(parse_field(*field, layout).value_or(std::nan("")));
    if (row.size() == layout.columns) rows.push_back(std::move(row));
  }
  return rows;
}

// Returns true if nearly all rows have a unit vector in three columns. The tolerance of 0.02 admits vectors
// with two decimals, whose length is uncertain by 0.01.
bool are_unit_vectors(const std::vector<Row>& rows, std::size_t column) {
  const auto is_unit = [&](const Row& row) {
    return std::abs(std::hypot(row[column], row[column + 1], row[column + 2]) - 1) < 0.02;
  };
  const auto units = std::ranges::count_if(rows, is_unit);
  return units > 0 && static_cast<double>(units) >= 0.9 * static_cast<double>(rows.size());
}

// Returns true if three columns are whole numbers from 0 to 255, some of them above the largest class, or
// fractions from 0 to 1.
bool are_colours(const std::vector<Row>& rows, std::size_t column) {
  double largest = 0;
  bool has_fractions = false;
  for (const Row& row : rows)
    for (std::size_t i = column; i < column + 3; ++i) {
      if (!(row[i] >= 0)) return false;
      largest = std::max(largest, row[i]);
      has_fractions |= row[i] != std::trunc(row[i]);
    }
  return has_fractions ? largest <= 1 : largest > largest_class && largest <= 255;
}

// A test of three consecutive columns.
using IsTriple = bool (*)(const std::vector<Row>&, std::size_t column);

bool find_triple(const std::vector<Row>& rows, IsTriple is_triple, std::span<const std::size_t> candidates,
                 std::span<std::size_t> columns) {
  for (const std::size_t column : candidates) {
    if (!is_triple(rows, column)) continue;
    for (std::size_t i = 0; i < 3; ++i) columns[i] = column + i;
    return true;
  }
  return false;
}

}  // namespace

bool has_coordinates(const ColumnNames& names) {
  std::array<std::size_t, 3> columns;
  return take_named(names, plane_names, std::span(columns).first(2)) &&
         take_named(names, height_names, std::span(columns).last(1));
}

bool has_degrees(const ColumnNames& names) {
  const auto has = [&](auto... spellings) { return ((find_name(names, spellings) < names.size()) || ...); };
  return has("longitude", "lon", "long", "lng") && has("latitude", "lat") && !has_coordinates(names);
}

void take_columns(const ColumnNames& names, XyzLayout& layout) {
  const std::span wanted(layout.wanted);
  take_named(names, plane_names, wanted.first(2));
  take_named(names, height_names, wanted.subspan(2, 1));
  layout.has_normals = take_named(names, normal_names, wanted.subspan(XyzLayout::first_normal, 3));
  layout.has_colours = take_named(names, colour_names, wanted.subspan(XyzLayout::first_colour, 3));
}

void find_columns(const Source& source, bool has_name, XyzLayout& layout) {
  if (layout.columns < 6 && !has_name) return;
  const auto rows = sample_rows(source.bytes.substr(layout.data_offset), layout);
  // If other rows begin with a number, the first column is not a name: a word in it replaces a missing
  // coordinate.
  const bool is_named =
      has_name && std::ranges::all_of(rows, [](const Row& row) { return std::isnan(row[0]); });
  const std::size_t first = is_named ? 1 : 0;
  for (std::size_t i = 0; i < 3; ++i) layout.wanted[i] = first + i;
  std::vector<std::size_t> candidates;
  for (std::size_t column = first + 3; column + 3 <= layout.columns; ++column) candidates.push_back(column);
  const std::span wanted(layout.wanted);
  layout.has_normals =
      find_triple(rows, are_unit_vectors, candidates, wanted.subspan(XyzLayout::first_normal, 3));
  // The columns of a normal are not a colour. After a line with the number of points (PTS), the fourth column
  // is the intensity.
  const std::size_t normal = layout.has_normals ? layout.wanted[XyzLayout::first_normal] : layout.columns + 3;
  const bool has_intensity = layout.promised_points && layout.columns > first + 6;
  std::erase_if(candidates, [&](std::size_t column) {
    return (column + 3 > normal && column < normal + 3) || (has_intensity && column == first + 3);
  });
  layout.has_colours = find_triple(rows, are_colours, candidates, wanted.subspan(XyzLayout::first_colour, 3));
}

}  // namespace relievo::io
