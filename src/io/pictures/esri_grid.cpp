// Reads text grids of terrain models, as GIS programs write them (Esri ASCII grid). Lines with a name and a
// number are followed by the heights, row by row from the north, with line breaks anywhere.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "io/pictures/geotiff.h"
#include "io/pictures/pictures.h"
#include "io/text.h"

namespace relievo::io {
namespace {

struct GridHeader {
  double columns = 0, rows = 0;
  Vec2 corner = Vec2::Zero();  // lower left corner of the grid, or centre of its lower left cell
  Vec2 cell = Vec2::Zero();
  double no_data = -9999;  // value for missing heights; the format's default
};

// Returns the header entry with that name; null for other names. `cellsize` sets only the width of a cell;
// check_header() copies it to the height.
double* find_entry(GridHeader& header, std::string_view name) {
  const std::array<std::pair<std::string_view, double*>, 10> entries = {{{"ncols", &header.columns},
                                                                         {"nrows", &header.rows},
                                                                         {"xllcorner", &header.corner.x()},
                                                                         {"xllcenter", &header.corner.x()},
                                                                         {"yllcorner", &header.corner.y()},
                                                                         {"yllcenter", &header.corner.y()},
                                                                         {"cellsize", &header.cell.x()},
                                                                         {"dx", &header.cell.x()},
                                                                         {"dy", &header.cell.y()},
                                                                         {"nodata_value", &header.no_data}}};
  const auto found = std::ranges::find_if(
      entries, [&](const auto& entry) { return equals_ignoring_case(name, entry.first); });
  return found == entries.end() ? nullptr : found->second;
}

// Returns the number in a word. Blanks separate the numbers, so a comma in a word is a decimal comma.
std::optional<double> number_in(std::string_view word) {
  if (!word.contains(',')) return parse_number(word);
  std::string with_point(word);
  std::ranges::replace(with_point, ',', '.');
  return parse_number(with_point);
}

// Reads the lines up to the first one that begins with a number. Returns that line.
Result<std::string_view> read_grid_header(SourceLines& lines, GridHeader& header) {
  while (const auto line = lines.next()) {
    Words words(*line);
    const std::string_view name = words.next(), word = words.next();
    if (name.empty()) continue;
    if (number_in(name)) return *line;
    double* entry = find_entry(header, name);
    const auto value = number_in(word);
    if (!entry || !value)
      return lines.fail(
          "expected ncols, nrows, cellsize or another entry of an Esri grid with its number, found " +
          in_quotes(*line));
    *entry = *value;
  }
  return lines.fail_at_end("the heights of an Esri grid");
}

Result<void> check_header(const Source& source, GridHeader& header) {
  if (header.cell.y() == 0) header.cell.y() = header.cell.x();
  const auto is_count = [](double n) { return n >= 1 && n == std::floor(n) && n <= 1e9; };
  if (!is_count(header.columns) || !is_count(header.rows))
    return source.error(
        {}, cat("expected ncols and nrows of an Esri grid, found ", header.columns, " and ", header.rows));
  constexpr std::uint64_t least_bytes = 2;  // a height has at least a digit and a separator
  const auto columns = static_cast<std::uint64_t>(header.columns),
             rows = static_cast<std::uint64_t>(header.rows);
  RELIEVO_CHECK(check_room(source, {columns, rows, 0, 0}));
  if (columns * rows <= source.bytes.size() / least_bytes + 1) return {};
  return source.error({}, cat("expected ", columns, " x ", rows, " heights, found ", source.bytes.size(),
                              " bytes; the file is cut, get it anew"));
}

// Returns whether the cells are probably given in degrees; the format has no entry for units. This is so if
// the corner is a position on the globe, and the range of the heights, in metres, would be far too large for
// the grid's sides.
bool has_degrees(const GridHeader& header, const Image<float>& heights) {
  const bool is_on_globe = std::abs(header.corner.x()) <= 360 && std::abs(header.corner.y()) <= 90 &&
                           header.corner.y() + header.rows * header.cell.y() <= 90;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const float z : heights.pixels)
    if (std::isfinite(z)) low = std::min(low, double{z}), high = std::max(high, double{z});
  return is_on_globe &&
         high - low > 5 * std::max(header.columns * header.cell.x(), header.rows * header.cell.y());
}

}  // namespace

bool is_esri_grid(const Source& source) {
  Lines lines(source.bytes, byte_order_mark_size(source.bytes));
  const auto first = lines.next();
  if (!first) return false;
  Words words(*first);
  const std::string_view name = words.next();
  return equals_ignoring_case(name, "ncols") || equals_ignoring_case(name, "nrows");
}

Result<DepthImage> read_esri_grid(const Source& source, const PictureChannels&) {
  GridHeader header;
  SourceLines lines(source);
  RELIEVO_TRY(std::string_view line, read_grid_header(lines, header));
  RELIEVO_CHECK(check_header(source, header));
  DepthImage image{{}, 0, "Esri grid"};
  image.values.resize(static_cast<int>(header.columns), static_cast<int>(header.rows));
  std::size_t n = 0;
  for (std::optional<std::string_view> rest = line; rest; rest = lines.next()) {
    Words words(*rest);
    for (std::string_view word = words.next(); !word.empty(); word = words.next(), ++n) {
      const auto value = number_in(word);
      if (!value) return lines.fail("expected a height, found " + in_quotes(word));
      if (n == image.values.size()) return lines.fail(cat("expected ", n, " heights, found more"));
      image.values[n] =
          *value == header.no_data ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(*value);
    }
  }
  if (n < image.values.size())
    return lines.fail_at_end(cat(image.values.size(), " heights"), cat(" after ", n));
  image.step = step_of(image.values);
  const double middle = header.corner.y() + header.rows * header.cell.y() / 2;
  image.pixel_size = has_degrees(header, image.values) ? metres_of_degrees(header.cell, middle) : header.cell;
  return image;
}

}  // namespace relievo::io
