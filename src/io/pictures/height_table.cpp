// Reads tables of heights, as written by microscopes, profilers and spreadsheets, and read by OpenSCAD's
// surface(). A line is a row of the picture, from the top.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "io/formats.h"
#include "io/pictures/pictures.h"
#include "io/pictures/table_labels.h"
#include "io/xyz.h"

namespace relievo::io {
namespace {

// With fewer than `least_columns` columns the text is a cloud; with at least `most_of_cloud` columns it is a
// table. In between, the values decide.
constexpr std::size_t least_columns = 8, most_of_cloud = 32;

constexpr float nowhere = std::numeric_limits<float>::quiet_NaN();

using NumberRows = std::vector<std::vector<double>>;

// Returns the correlation of a column with the next one; nothing if one of them is constant. Neighbouring
// heights of a surface correlate, but the x and y of a cloud do not correlate.
std::optional<double> correlation(const NumberRows& rows, std::size_t column) {
  double n = 0, a = 0, b = 0, aa = 0, bb = 0, ab = 0;
  for (const auto& row : rows) {
    const double x = row[column], y = row[column + 1];
    if (!std::isfinite(x) || !std::isfinite(y)) continue;
    n += 1, a += x, b += y, aa += x * x, bb += y * y, ab += x * y;
  }
  const double spread = (n * aa - a * a) * (n * bb - b * b), rounding = 1e-12 * n * n * aa * bb;
  if (!(spread > rounding)) return std::nullopt;
  return (n * ab - a * b) / std::sqrt(spread);
}

// Returns whether three quarters of the non-constant columns, and half of all columns, correlate with their
// neighbours.
bool are_neighbours_alike(const NumberRows& rows, std::size_t columns) {
  std::size_t alike = 0, varying = 0;
  for (std::size_t i = 0; i + 1 < columns; ++i) {
    const auto r = correlation(rows, i);
    varying += r.has_value();
    alike += r > .5;
  }
  return 4 * alike >= 3 * varying && 2 * alike >= columns - 1;
}

bool is_table(const Source& source, const XyzLayout& layout) {
  if (layout.has_names || layout.promised_points || layout.columns < least_columns) return false;
  if (layout.columns >= most_of_cloud) return true;
  if (layout.has_normals) return false;
  return are_neighbours_alike(sample_rows(source.bytes.substr(layout.data_offset), layout), layout.columns);
}

// Returns the layout of a table; nothing if the text is not a table.
std::optional<XyzLayout> find_table(const Source& source) {
  if (!foreign_format(source).empty()) return std::nullopt;
  std::optional<XyzLayout> layout;
  const auto is_marked = [&](const Format& format) {
    return format.is_format != is_text && format.is_format(source);
  };
  if (auto found = find_layout(source))
    layout = *found;
  else if (std::ranges::none_of(formats, is_marked))
    layout = find_table_behind_words(source);
  return layout && is_table(source, *layout) ? layout : std::nullopt;
}

// Appends a line of the table. A field that is not a number is missing, and so is an empty last field.
void take_row(std::string_view line, const XyzLayout& layout, std::vector<float>& values) {
  const std::size_t before = values.size();
  Fields fields(line, layout.separator);
  while (const auto field = fields.next()) {
    const auto value = parse_field(*field, layout);
    values.push_back(value ? static_cast<float>(*value) : nowhere);
  }
  if (values.size() + 1 == before + layout.columns && line.ends_with(layout.separator))
    values.push_back(nowhere);
}

}  // namespace

bool is_height_table(const Source& source) {
  return find_table(source).has_value();
}

Result<DepthImage> read_height_table(const Source& source, const PictureChannels&) {
  const XyzLayout layout = find_table(source).value_or(XyzLayout{});  // is_height_table() has checked it
  SourceLines lines(source, layout.data_offset, layout.first_line - 1);
  std::vector<float> values;
  std::size_t rows = 0;
  while (const auto raw = lines.next()) {
    const std::string_view line = without_comment(*raw);
    if (line.empty()) continue;
    take_row(line, layout, values);
    if (values.size() != ++rows * layout.columns)
      return lines.fail(cat("expected ", layout.columns, " heights as in line ", layout.first_line,
                            ", found ", values.size() - (rows - 1) * layout.columns));
    if (values.size() > most_pixels)
      return lines.fail(cat("expected at most ", most_pixels, " heights, found more"));
  }
  DepthImage image{{}, 0, "table of heights"};
  image.values = {static_cast<int>(layout.columns), static_cast<int>(rows), 1, std::move(values)};
  drop_labels(image);
  image.step = step_of(image.values);
  return image;
}

}  // namespace relievo::io
