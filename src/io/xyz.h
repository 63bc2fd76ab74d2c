// Determines the layout of text files with one point per line (XYZ, PTS, CSV).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/readers.h"
#include "io/text.h"

namespace relievo::io {

// Iterates over the fields of a line: words if `separator` is ' ', otherwise the texts between separators,
// without surrounding blanks and quotation marks. A separator at the end of the line ends the last field, and
// is not followed by an empty field.
class Fields {
 public:
  Fields(std::string_view line, char separator) : line_(line), words_(line), separator_(separator) {}

  std::optional<std::string_view> next();

 private:
  std::string_view line_;
  Words words_;
  char separator_;
};

// Returns the line without comment (# or //) and without blanks at its ends.
std::string_view without_comment(std::string_view line);

using ColumnNames = std::vector<std::string_view>;

struct XyzLayout {
  static constexpr std::size_t most_wanted = 9, first_normal = 3, first_colour = 6;
  char separator = ' ';
  bool has_decimal_commas = false;                          // whether commas replace decimal points
  std::size_t columns = 0;                                  // number of columns in every line
  std::array<std::size_t, most_wanted> wanted = {0, 1, 2};  // columns of x y z nx ny nz red green blue
  bool has_names = false;                                   // whether a line has names of the columns
  bool has_normals = false, has_colours = false;
  bool has_scan_positions = false;              // the first two columns are a scanner's row and column
  bool is_numbered = false;                     // the first column is the number of the point
  std::optional<std::int64_t> promised_points;  // number of points, if a first line states it
  std::size_t promising_line = 0;
  std::size_t first_line = 0;  // first line of data, counted from 1
  std::size_t data_offset = 0;
};

// Returns the number in a field, with a decimal comma if the layout has decimal commas.
std::optional<double> parse_field(std::string_view field, const XyzLayout& layout);

// Returns whether the names include coordinates: x, y and z, or easting, northing and elevation, or others.
bool has_coordinates(const ColumnNames& names);

// Returns whether the only coordinates among the names are longitude and latitude.
bool has_degrees(const ColumnNames& names);

// Set the columns of coordinates, normals and colours. take_columns() finds the columns by their names.
// find_columns() finds normals and colours by their values in lines from the whole file. It takes the first
// three columns as coordinates, or the three after a scanner's row and column, a point's number or a name. It
// expects a name only if `has_name` is set and no sampled line begins with a number.
void take_columns(const ColumnNames& names, XyzLayout& layout);
void find_columns(const Source& source, bool has_name, XyzLayout& layout);

// Returns whether nearly all rows have a unit vector in three columns from `column` on. The tolerance of 0.02
// admits vectors with two decimals, whose length has an error of up to 0.01.
bool are_unit_vectors(const std::vector<std::vector<double>>& rows, std::size_t column);

// Returns whether three columns are colours: integers from 0 to 255 that are not all classes of points (0 to
// 31), or fractions from 0 to 1.
bool are_colours(const std::vector<std::vector<double>>& rows, std::size_t column);

// Finds the columns of normals and colours by their values in the rows. The columns `first` to first + 2 are
// coordinates.
void find_normals_and_colours(const std::vector<std::vector<double>>& rows, std::size_t first,
                              XyzLayout& layout);

// Returns a description of the columns, such as "6 columns with normals".
std::string columns_text(const XyzLayout& layout);

// Returns up to 256 rows of numbers from the whole file. Rows whose number of columns differs from the
// layout's are left out. Words that are not numbers become NaN.
std::vector<std::vector<double>> sample_rows(std::string_view data, const XyzLayout& layout);

// Sets the separator, the decimal mark and the number of columns from a line of data, whose number is
// layout.first_line. Errors: kind input if a comma could be a separator or a decimal comma.
Result<void> take_separators(const Source& source, std::string_view line, XyzLayout& layout);

// Detects the layout: the separator and the number of columns from the first line of data, and the meaning of
// the columns from their names. If the file has no names, lines from the whole file show which columns are
// normals and colours.
Result<XyzLayout> find_layout(const Source& source);

}  // namespace relievo::io
