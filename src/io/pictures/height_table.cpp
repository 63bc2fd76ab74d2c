// Reads tables of heights, as written by microscopes, profilers and spreadsheets, and read by OpenSCAD's
// surface(). A line is a row of the picture, from the top.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "io/formats.h"
#include "io/pictures/pictures.h"
#include "io/readers.h"
#include "io/xyz.h"
#include "relievo/scan/depth_image.h"

namespace relievo::io {
namespace {

constexpr std::size_t enough_numbers = 8;

// Returns whether the line has at least 8 numbers, whatever separates them.
bool has_numbers(std::string_view line) {
  const std::string_view separators = " \t\v\f,;";
  std::size_t count = 0;
  for (std::size_t at = line.find_first_not_of(separators); at < line.size() && count < enough_numbers;) {
    const std::size_t end = std::min(line.find_first_of(separators, at), line.size());
    count += parse_number(line.substr(at, end - at)).has_value();
    at = line.find_first_not_of(separators, end);
  }
  return count >= enough_numbers;
}

// Returns whether the line is a row of the table: it has as many fields as the layout has columns, or one
// less if the line ends with a separator. To exclude names of columns, some fields must be numbers, or all
// fields must be the same.
bool is_row(std::string_view line, const XyzLayout& layout) {
  Fields fields(line, layout.separator);
  std::string_view first;
  std::size_t count = 0;
  bool has_number = false, are_same = true;
  for (; const auto field = fields.next(); ++count) {
    if (count == 0) first = *field;
    are_same &= *field == first;
    has_number |= parse_field(*field, layout).has_value();
  }
  const bool is_whole =
      count == layout.columns || (count + 1 == layout.columns && line.ends_with(layout.separator));
  return is_whole && (has_number || are_same);
}

// Numbers with equal steps in the first row or the first column of the table. `first` is the first number, in
// the table's corner or, if that is empty, next to it.
struct Progression {
  double first = 0, step = 0;

  bool counts() const { return step == 1 && (first == 0 || first == 1); }
};

// Returns the progression of the values at(begin) to at(size - 1). They may deviate from equal steps, because
// files round them. Returns nothing if they are no progression.
template <typename At>
std::optional<Progression> progression(std::size_t begin, std::size_t size, const At& at) {
  constexpr double rounding = .05;  // largest deviation, as a share of a step
  if (begin + 4 > size) return std::nullopt;
  const double first = double{at(begin)}, last = double{at(size - 1)};
  const double step = (last - first) / static_cast<double>(size - 1 - begin);
  for (std::size_t i = begin; i < size; ++i) {
    const double expected = first + static_cast<double>(i - begin) * step;
    if (!(std::abs(double{at(i)} - expected) <= rounding * std::abs(step))) return std::nullopt;
  }
  return step != 0 ? std::optional(Progression{first, step}) : std::nullopt;
}

// Removes the first `rows` rows and `columns` columns.
void crop(Image<float>& image, int columns, int rows) {
  Image<float> rest;
  rest.resize(image.width - columns, image.height - rows);
  for (int y = 0; y < rest.height; ++y)
    for (int x = 0; x < rest.width; ++x) rest.at(x, y) = image.at(x + columns, y + rows);
  image = std::move(rest);
}

// Returns the layout of a text whose table begins after other lines, such as the settings of an instrument or
// rows without any value. Returns nothing if no line has 8 numbers.
std::optional<XyzLayout> find_table_behind_words(const Source& source) {
  constexpr std::size_t most_lines = 5000;
  SourceLines lines(source);
  std::size_t begin = lines.offset();
  std::optional<std::string_view> line;
  while ((line = lines.next()) && !has_numbers(*line) && lines.number() < most_lines) begin = lines.offset();
  if (!line || !has_numbers(*line)) return std::nullopt;
  XyzLayout layout;
  layout.first_line = lines.number();
  if (!take_separators(source, without_comment(*line), layout)) return std::nullopt;
  SourceLines before(source);
  for (std::size_t at = before.offset(); at < begin; at = before.offset()) {
    const auto words = before.next();
    if (!is_row(*words, layout)) continue;
    begin = at, layout.first_line = before.number();
    break;
  }
  layout.data_offset = begin;
  return layout;
}

// Removes the row above the table that numbers the columns, and the column on the left that numbers the rows,
// as spreadsheets and pandas write them. If the corner between them is empty, the labels may also be
// coordinates at equal distances, instead of numbers; these distances become the size of pixels.
void drop_labels(DepthImage& table) {
  Image<float>& values = table.values;
  const auto columns = static_cast<std::size_t>(values.width), rows = static_cast<std::size_t>(values.height);
  if (columns < 5 || rows < 5) return;
  const auto in_row = [&](int row) {
    return [&values, row](std::size_t i) { return values.at(static_cast<int>(i), row); };
  };
  const auto in_column = [&](int column) {
    return [&values, column](std::size_t i) { return values.at(column, static_cast<int>(i)); };
  };
  const bool has_corner = std::isfinite(values[0]);
  const std::size_t begin = has_corner ? 0 : 1;
  const auto above = progression(begin, columns, in_row(0)), left = progression(begin, rows, in_column(0));
  const bool are_places = !has_corner && above && left;
  // The first row may have heights 0, 1, 2 ... instead of column numbers. Then the second row is usually a
  // progression, too, and the first row is kept. The same holds for the first column.
  const bool is_above = are_places || (above && above->counts() && !progression(begin, columns, in_row(1)));
  const bool is_left = are_places || (left && left->counts() && !progression(begin, rows, in_column(1)));
  if (are_places && !(above->counts() && left->counts()))
    table.pixel_size = {std::abs(above->step), std::abs(left->step)};
  if (!is_above && !is_left) return;
  crop(values, is_left ? 1 : 0, is_above ? 1 : 0);
  table.format += ", without the numbers or places of its rows and columns";
}

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
