#include "io/xyz.h"

#include <algorithm>
#include <cmath>

#include "io/formats.h"
#include "relievo/core/text.h"

namespace relievo::io {
namespace {

class XyzReader {
 public:
  XyzReader(const Source& source, const XyzLayout& layout)
      : layout_(layout),
        lines_(source, layout.data_offset, layout.first_line - 1),
        slots_(layout.columns, XyzLayout::most_wanted),
        promised_(static_cast<std::size_t>(layout.promised_points.value_or(0))),
        promising_line_(layout.promising_line) {
    const auto take_slots = [&](std::size_t first) {
      for (std::size_t i = first; i < first + 3; ++i) slots_[layout.wanted[i]] = i;
    };
    take_slots(0);
    if (layout.has_normals) take_slots(XyzLayout::first_normal);
    if (layout.has_colours) take_slots(XyzLayout::first_colour);
  }

  Result<Cloud> read() {
    while (const auto raw = lines_.next()) {
      const std::string_view line = without_comment(*raw);
      if (line.empty()) continue;
      if (cloud_.points.empty()) make_room(lines_.source().bytes.size() / (line.size() + 1));
      if (!begins_block(line)) RELIEVO_CHECK(take(line));
    }
    if (promised_ > cloud_.size())
      return lines_.fail_at_end(cat(promised_ - before_block_, " points as line ", promising_line_, " says"),
                                cat(" after ", cloud_.size() - before_block_));
    if (layout_.has_colours) cloud_.colours = colours_in_bytes(colours_);
    return std::move(cloud_);
  }

 private:
  void make_room(std::size_t points) {
    cloud_.points.reserve(points);
    if (layout_.has_normals) cloud_.normals.reserve(points);
    if (layout_.has_colours) colours_.reserve(points);
  }

  // Begins another scan and returns true if the line is the number of points of that scan. Such a line may
  // follow when the last scan has as many points as promised.
  bool begins_block(std::string_view line) {
    if (!layout_.promised_points || promised_ != cloud_.size()) return false;
    const auto points = parse_integer(line);
    if (!points || *points < 0 || *points >= std::int64_t{no_index}) return false;
    before_block_ = promised_;
    promised_ += static_cast<std::size_t>(*points);
    promising_line_ = lines_.number();
    return true;
  }

  Result<void> take(std::string_view line) {
    Fields fields(line, layout_.separator);
    std::size_t column = 0;
    for (auto field = fields.next(); field; field = fields.next(), ++column) {
      const std::size_t slot = column < layout_.columns ? slots_[column] : XyzLayout::most_wanted;
      if (slot == XyzLayout::most_wanted) continue;
      const auto value = parse_field(*field, layout_);
      const bool is_colour = slot >= XyzLayout::first_colour;  // a point without colour is black
      if (!value && !is_colour)
        return lines_.fail(cat("expected a number in column ", column + 1, ", found ", in_quotes(*field)));
      values_[slot] = value.value_or(0);
    }
    if (column != layout_.columns)
      return lines_.fail(
          cat("expected ", layout_.columns, " columns as in line ", layout_.first_line, ", found ", column));
    cloud_.points.emplace_back(values_[0], values_[1], values_[2]);
    if (layout_.has_normals) cloud_.normals.push_back(unit_normal(Vec3(values_[3], values_[4], values_[5])));
    if (layout_.has_colours) colours_.push_back(Vec3(values_[6], values_[7], values_[8]).cast<float>());
    return {};
  }

  const XyzLayout& layout_;
  SourceLines lines_;
  std::vector<std::size_t> slots_;  // per column: index in values_; most_wanted if the column is not read
  std::array<double, XyzLayout::most_wanted> values_ = {};
  // `promised_` is the number of points that the file promises up to the end of this scan. Line
  // `promising_line_` has the number for this scan alone. `before_block_` is the number of points before this
  // scan.
  std::size_t promised_, promising_line_, before_block_ = 0;
  Cloud cloud_;
  std::vector<Vec3f> colours_;  // colours as the file has them, in any range
};

std::string to_string(const XyzLayout& layout) {
  return (layout.promised_points ? "PTS text, " : "XYZ text, ") + columns_text(layout) +
         (layout.has_scan_positions ? " after row and column"
          : layout.is_numbered      ? " after the point's number"
                                    : "");
}

using Row = std::vector<double>;

using Names = std::span<const std::string_view>;

// Names of coordinates in files of other programs, the most common ones first. The names for the plane are in
// pairs, such as "x" and "y"; each name for the height is alone.
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

// Classes of points in LAS go up to 31. If three columns of integers have no number above this value, they
// count as classes or numbers of returns, not as colours.
constexpr double largest_class = 31;

std::size_t find_name(const ColumnNames& names, std::string_view wanted) {
  const auto found =
      std::ranges::find_if(names, [&](auto name) { return equals_ignoring_case(name, wanted); });
  return static_cast<std::size_t>(found - names.begin());
}

// Looks for a group of columns among the file's names. `spellings` is a list of groups of names; the first
// group that is complete in the file sets the columns. Returns false if no group is complete.
bool take_named(const ColumnNames& names, Names spellings, std::span<std::size_t> columns) {
  for (; !spellings.empty(); spellings = spellings.subspan(columns.size())) {
    for (std::size_t i = 0; i < columns.size(); ++i) columns[i] = find_name(names, spellings[i]);
    if (std::ranges::all_of(columns, [&](std::size_t column) { return column < names.size(); })) return true;
  }
  return false;
}

// Returns the line around a byte, or its part within 1,000 bytes. Without this limit, a file of a single long
// line would be searched once per sample.
std::string_view line_around(std::string_view data, std::size_t byte) {
  const std::size_t limit = 1000, first = byte - std::min(byte, limit);
  const std::string_view left = data.substr(first, byte - first), right = data.substr(byte, limit);
  const std::size_t begin = left.find_last_of("\r\n") + 1;  // without a line break, npos + 1 is 0
  const std::size_t end = std::min(right.find_first_of("\r\n"), right.size());
  return data.substr(first + begin, byte + end - first - begin);
}

// A test of three consecutive columns.
using IsTriple = bool (*)(const std::vector<Row>&, std::size_t column);

// Returns whether the coordinates come after a scanner's row and column: two columns of integers, then three
// columns with fractions in most rows. Returns false if the columns may be three coordinates and a normal or
// a colour.
bool has_scan_positions(const std::vector<Row>& rows, std::size_t columns) {
  if (rows.empty() || columns < 5) return false;
  if (columns >= 6 && (are_unit_vectors(rows, 3) || (columns == 6 && are_colours(rows, 3)))) return false;
  const auto has_fraction = [](double value) { return value != std::trunc(value); };
  for (std::size_t column = 0; column < 5; ++column) {
    const auto fractions =
        std::ranges::count_if(rows, [&](const Row& row) { return has_fraction(row[column]); });
    const bool is_right =
        column < 2
            ? fractions == 0 && std::ranges::all_of(rows, [&](const Row& row) { return row[column] >= 0; })
            : 2 * static_cast<std::size_t>(fractions) > rows.size();
    if (!is_right) return false;
  }
  return true;
}

// Returns a line's fields as numbers. Words that are not numbers become NaN.
Row row_of(std::string_view line, const XyzLayout& layout) {
  Row row;
  Fields fields(line, layout.separator);
  while (const auto field = fields.next()) row.push_back(parse_field(*field, layout).value_or(std::nan("")));
  return row;
}

// Returns the first rows of the file, up to 64.
std::vector<Row> first_rows(std::string_view data, const XyzLayout& layout) {
  constexpr std::size_t most = 64;
  std::vector<Row> rows;
  Lines lines(data);
  while (rows.size() < most) {
    const auto line = lines.next();
    if (!line) break;
    if (const std::string_view plain = without_comment(*line); !plain.empty())
      rows.push_back(row_of(plain, layout));
  }
  return rows;
}

// Returns whether the first column grows from row to row. In samples of rows the number may also stay the
// same, because a row may be sampled twice.
bool grows(const std::vector<Row>& rows, bool is_sample) {
  return std::ranges::adjacent_find(rows, [&](const Row& a, const Row& b) {
           return !(a[0] < b[0] || (is_sample && a[0] == b[0]));
         }) == rows.end();
}

// Returns whether the first column numbers the points. It must have integers that grow from row to row,
// unlike the x of a surface. The next three columns must have fractions in most rows.
bool are_numbered(const std::vector<Row>& samples, const std::vector<Row>& first) {
  constexpr std::size_t fewest = 8;
  const auto has_no_row = [](const Row& row) { return row.size() < 4; };
  if (samples.empty() || first.size() < fewest || std::ranges::any_of(first, has_no_row) ||
      std::ranges::any_of(samples, has_no_row))
    return false;
  // Six columns with coordinates and a normal or a colour have no column left for numbers of points.
  if (samples[0].size() == 6 && (are_unit_vectors(samples, 3) || are_colours(samples, 3))) return false;
  std::array<std::size_t, 4> fractions = {};
  for (const Row& row : samples)
    for (std::size_t c = 0; c < fractions.size(); ++c) fractions[c] += row[c] != std::trunc(row[c]);
  return fractions[0] == 0 && samples[0][0] >= 0 && grows(first, false) && grows(samples, true) &&
         std::ranges::all_of(std::span(fractions).last(3), [&](auto n) { return 2 * n > samples.size(); });
}

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

bool is_text(const Source& source) {
  return foreign_format(source).empty();
}

Result<RawCloud> read_text(const Source& source) {
  RELIEVO_TRY(const auto layout, find_layout(source));
  RELIEVO_TRY(auto cloud, XyzReader(source, layout).read());
  return RawCloud{std::move(cloud), to_string(layout)};
}

std::vector<Row> sample_rows(std::string_view data, const XyzLayout& layout) {
  const std::size_t samples = 256;
  std::vector<Row> rows;
  for (std::size_t i = 0; i < samples; ++i) {
    Row row = row_of(without_comment(line_around(data, data.size() * i / samples)), layout);
    if (row.size() == layout.columns) rows.push_back(std::move(row));
  }
  return rows;
}

std::string columns_text(const XyzLayout& layout) {
  return cat(layout.columns, " columns",
             layout.has_normals && layout.has_colours ? " with normals and colours"
             : layout.has_normals                     ? " with normals"
             : layout.has_colours                     ? " with colours"
                                                      : "");
}

bool are_unit_vectors(const std::vector<Row>& rows, std::size_t column) {
  const auto is_unit = [&](const Row& row) {
    return std::abs(std::hypot(row[column], row[column + 1], row[column + 2]) - 1) < 0.02;
  };
  const auto units = std::ranges::count_if(rows, is_unit);
  return units > 0 && static_cast<double>(units) >= 0.9 * static_cast<double>(rows.size());
}

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
  if (layout.columns < 4 && !has_name) return;
  const std::string_view data = source.bytes.substr(layout.data_offset);
  const auto rows = sample_rows(data, layout);
  // The first column has names only if no row begins with a number. If some row does, a word in the first
  // column stands for a missing coordinate.
  const bool is_named =
      has_name && std::ranges::all_of(rows, [](const Row& row) { return std::isnan(row[0]); });
  layout.has_scan_positions = !has_name && has_scan_positions(rows, layout.columns);
  layout.is_numbered =
      !has_name && !layout.has_scan_positions && are_numbered(rows, first_rows(data, layout));
  const std::size_t first = layout.has_scan_positions ? 2 : is_named || layout.is_numbered ? 1 : 0;
  for (std::size_t i = 0; i < 3; ++i) layout.wanted[i] = first + i;
  find_normals_and_colours(rows, first, layout);
}

void find_normals_and_colours(const std::vector<Row>& rows, std::size_t first, XyzLayout& layout) {
  std::vector<std::size_t> candidates;
  for (std::size_t column = first + 3; column + 3 <= layout.columns; ++column) candidates.push_back(column);
  const std::span wanted(layout.wanted);
  layout.has_normals =
      find_triple(rows, are_unit_vectors, candidates, wanted.subspan(XyzLayout::first_normal, 3));
  // The columns of a normal are not a colour. If a first line states the number of points (PTS), the fourth
  // column is the intensity.
  const std::size_t normal = layout.has_normals ? layout.wanted[XyzLayout::first_normal] : layout.columns + 3;
  const bool has_intensity = layout.promised_points && layout.columns > first + 6;
  std::erase_if(candidates, [&](std::size_t column) {
    return (column + 3 > normal && column < normal + 3) || (has_intensity && column == first + 3);
  });
  layout.has_colours = find_triple(rows, are_colours, candidates, wanted.subspan(XyzLayout::first_colour, 3));
}

}  // namespace relievo::io
