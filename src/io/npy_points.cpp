// Reads NumPy's arrays of points. An array has rows of coordinates, or pictures with a point in each pixel.
// Such pictures come from programs that estimate points from photographs. Tested by tests/io/npy_test.cpp.
#include <algorithm>

#include "io/formats.h"
#include "io/npy.h"
#include "io/xyz.h"
#include "relievo/core/parallel.h"
#include "relievo/core/text.h"

namespace relievo::io {
namespace {

// Returns the number of points: the product of all sizes but the last. Errors: kind input if the file has
// fewer points.
Result<std::size_t> count_rows(const Source& source, const NpyArray& array) {
  const std::size_t room = source.bytes.size() - array.data;
  const std::size_t row_bytes = array.bytes_per_number() * array.sizes.back();
  const std::size_t most = std::min<std::size_t>(room / row_bytes, no_index - 1);
  std::size_t rows = 1;
  for (std::size_t i = 0; i + 1 < array.sizes.size(); ++i) {
    if (array.sizes[i] > 0 && rows > most / array.sizes[i])
      return source.error_at_byte(
          array.data, cat("expected the points of an array (", printable(array.shape), "), found room for ",
                          most, "; the file is cut, get it anew"));
    rows *= array.sizes[i];
  }
  return rows;
}

// Returns up to 256 rows from the whole array.
std::vector<std::vector<double>> rows_among(const Source& source, const NpyArray& array, std::size_t rows) {
  constexpr std::size_t most = 256;
  std::vector<std::vector<double>> some(std::min(rows, most), std::vector<double>(array.sizes.back()));
  for (std::size_t i = 0; i < some.size(); ++i)
    for (std::size_t c = 0; c < some[i].size(); ++c)
      some[i][c] = array.number<double>(source, rows * i / some.size(), c);
  return some;
}

// Returns an error if the pixels of pictures are normals or colours, which also have three numbers.
Result<void> check_pictures(const Source& source, const std::vector<std::vector<double>>& rows) {
  const std::string_view found = are_unit_vectors(rows, 0) ? "normals"
                                 : are_colours(rows, 0)    ? "colours"
                                                           : "";
  if (found.empty()) return {};
  return source.error({}, cat("expected a picture of points, found one of ", found,
                              "; in Python a.reshape(-1, 3) makes a list of points of it"));
}

// Sets one vector per row from three columns.
template <typename Vector, typename Convert>
void fill_vectors(const Source& source, const NpyArray& array, std::size_t first, std::vector<Vector>& to,
                  const Convert& convert) {
  parallel_for(to.size(), [&](std::size_t i) {
    const auto number = [&](std::size_t column) { return array.number<double>(source, i, column); };
    to[i] = convert(Vec3(number(first), number(first + 1), number(first + 2)));
  });
}

}  // namespace

bool is_npy_points(const Source& source) {
  if (!has_npy_mark(source)) return false;
  const auto array = read_npy_header(source);
  return array && array->has_points();
}

Result<RawCloud> read_npy_points(const Source& source) {
  RELIEVO_TRY(const NpyArray array, read_npy_header(source));
  RELIEVO_TRY(const std::size_t rows, count_rows(source, array));
  XyzLayout layout;
  layout.columns = array.sizes.back();
  const std::vector<std::vector<double>> some = rows_among(source, array, rows);
  if (array.sizes.size() > 2) RELIEVO_CHECK(check_pictures(source, some));
  find_normals_and_colours(some, 0, layout);
  RawCloud raw{{}, cat("NPY, ", array.samples.bits, " bits, ", columns_text(layout))};
  raw.cloud.points.resize(rows);
  fill_vectors(source, array, 0, raw.cloud.points, [](const Vec3& point) { return point; });
  if (layout.has_normals) {
    raw.cloud.normals.resize(rows);
    fill_vectors(source, array, layout.wanted[XyzLayout::first_normal], raw.cloud.normals, unit_normal);
  }
  if (layout.has_colours) {
    std::vector<Vec3f> colours(rows);
    fill_vectors(source, array, layout.wanted[XyzLayout::first_colour], colours,
                 [](const Vec3& colour) { return Vec3f(colour.cast<float>()); });
    raw.cloud.colours = colours_in_bytes(colours);
  }
  if (array.sizes.size() == 3) raw.columns = array.sizes[1];
  return raw;
}

}  // namespace relievo::io
