#include "io/pictures/table_labels.h"

#include <algorithm>
#include <cmath>

#include "io/formats.h"

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

// Returns whether the line is a row of the table: it has as many fields as a row, or one less if the last one
// is empty. To exclude names of columns, some fields must be numbers, or all fields must be the same.
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

}  // namespace

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

}  // namespace relievo::io
