#include "native/arrays.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "native/errors.h"
#include "relievo/core/text.h"
#include "relievo/scan/normals.h"

namespace relievo::python {
namespace {

// The largest number of points for which the library has indices, see delaunay().
constexpr py::ssize_t most_rows = (py::ssize_t{1} << 29) - 2;

std::string shape_text(const py::array& array) {
  std::string text = "(";
  for (py::ssize_t i = 0; i < array.ndim(); ++i) text += cat(i > 0 ? ", " : "", array.shape(i));
  return text + (array.ndim() == 1 ? ",)" : ")");
}

std::string dtype_text(const py::array& array) {
  return py::str(array.dtype()).cast<std::string>();
}

[[noreturn]] void raise_shape(const NamedArray& given, std::string_view expected) {
  raise_input(given.name, "shape", cat("expected ", expected, ", found ", shape_text(given.array)));
}

// Calls f with a function that returns the number in a given row and column, for arrays of any type of number.
template <typename F>
void with_reader(const NamedArray& given, F&& f) {
  const py::array& array = given.array;
  const auto strides = std::pair(array.strides(0), array.ndim() > 1 ? array.strides(1) : 0);
  const auto* const data = static_cast<const std::byte*>(array.data());
  const auto read_as = [&]<typename T>(T) {
    f([data, strides](py::ssize_t row, py::ssize_t column) {
      T value;  // its address may be unaligned
      std::memcpy(&value, data + row * strides.first + column * strides.second, sizeof value);
      return value;
    });
  };
  const py::dtype type = array.dtype();
  const char kind = type.kind();
  const py::ssize_t size = type.itemsize();
  const bool is_native = type.attr("isnative").cast<bool>();
  if (is_native && kind == 'f' && size == 8) return read_as(double{});
  if (is_native && kind == 'f' && size == 4) return read_as(float{});
  if (is_native && kind == 'i' && size == 8) return read_as(std::int64_t{});
  if (is_native && kind == 'i' && size == 4) return read_as(std::int32_t{});
  if (is_native && kind == 'u' && size == 4) return read_as(std::uint32_t{});
  if (is_native && kind == 'u' && size == 2) return read_as(std::uint16_t{});
  if (kind == 'u' && size == 1) return read_as(std::uint8_t{});
  if (kind != 'f' && kind != 'i' && kind != 'u')
    raise_input(given.name, "dtype", cat("expected numbers, found ", dtype_text(array)));
  // Arrays in half or extended precision, or in the other byte order, are rare. They are first converted to a copy.
  const char* const plain = kind == 'f' ? "float64" : "int64";
  return with_reader({given.name, py::array(array.attr("astype")(plain))}, std::forward<F>(f));
}

// Calls f(row, at) for each row, where at(row, column) returns a number.
template <typename F>
void for_each_row(const NamedArray& given, F&& f) {
  with_reader(given, [&](const auto& at) {
    for (py::ssize_t row = 0; row < given.array.shape(0); ++row) f(row, at);
  });
}

template <int n>
void check_shape(const NamedArray& given) {
  const py::array& array = given.array;
  if (array.ndim() != 2 || array.shape(1) != n) raise_shape(given, cat("(N, ", n, ")"));
  if (array.shape(0) == 0) raise_shape(given, "at least one row");
  if (array.shape(0) > most_rows) raise_shape(given, cat("at most ", most_rows, " rows"));
}

void check_rows(const NamedArray& given, std::size_t size) {
  if (given.array.ndim() < 1 || given.array.shape(0) != static_cast<py::ssize_t>(size))
    raise_shape(given, cat("a row for each of ", size, " points"));
}

[[noreturn]] void raise_row(const NamedArray& given, py::ssize_t row, std::string expected) {
  raise_input(given.name, cat("row ", row), std::move(expected));
}

template <int n>
Eigen::Matrix<double, n, 1> finite_row(const NamedArray& given, py::ssize_t i, const auto& at) {
  Eigen::Matrix<double, n, 1> row;
  for (int c = 0; c < n; ++c) row[c] = static_cast<double>(at(i, c));
  if (!row.allFinite()) raise_row(given, i, "expected finite numbers, found others");
  return row;
}

template <int n>
std::vector<Eigen::Matrix<double, n, 1>> rows_of(const NamedArray& given) {
  check_shape<n>(given);
  std::vector<Eigen::Matrix<double, n, 1>> rows(static_cast<std::size_t>(given.array.shape(0)));
  for_each_row(given, [&](py::ssize_t i, const auto& at) {
    rows[static_cast<std::size_t>(i)] = finite_row<n>(given, i, at);
  });
  return rows;
}

void check_whole(const NamedArray& given) {
  const char kind = given.array.dtype().kind();
  if (kind != 'i' && kind != 'u')
    raise_input(given.name, "dtype", cat("expected whole numbers, found ", dtype_text(given.array)));
}

// Returns the value as an index of one of `size` points. Raises if it is out of range.
Index index_of(const NamedArray& given, py::ssize_t row, std::int64_t value, std::size_t size) {
  if (value < 0 || value >= static_cast<std::int64_t>(size))
    raise_row(given, row, cat("expected numbers of points from 0 to ", size - 1, ", found ", value));
  return static_cast<Index>(value);
}

}  // namespace

std::vector<Vec3> points_of(const NamedArray& given) {
  return rows_of<3>(given);
}

std::vector<Vec2> plane_points_of(const NamedArray& given) {
  return rows_of<2>(given);
}

std::vector<Vec3f> normals_of(const NamedArray& given, std::size_t size) {
  check_shape<3>(given);
  check_rows(given, size);
  std::vector<Vec3f> normals(size);
  for_each_row(given, [&](py::ssize_t i, const auto& at) {
    Vec3f& normal = normals[static_cast<std::size_t>(i)];
    normal = unit_normal(finite_row<3>(given, i, at));
    if (normal.isZero(0)) raise_row(given, i, "expected a direction, found zeros");
  });
  return normals;
}

std::vector<Colour> colours_of(const NamedArray& given, std::size_t size) {
  check_rows(given, size);
  if (given.array.ndim() != 2 || given.array.shape(1) < 3 || given.array.shape(1) > 4)
    raise_shape(given, "(N, 3) or (N, 4)");
  const bool is_bytes = given.array.dtype().kind() == 'u' && given.array.dtype().itemsize() == 1;
  if (!is_bytes && given.array.dtype().kind() != 'f')
    raise_input(given.name, "dtype", cat("expected uint8 or fractions, found ", dtype_text(given.array)));
  std::vector<Colour> colours(size);
  for_each_row(given, [&](py::ssize_t i, const auto& at) {
    for (int c = 0; c < 3; ++c) {
      const double value = static_cast<double>(at(i, c)) * (is_bytes ? 1 : 255);
      if (!(value >= 0 && value <= 255)) raise_row(given, i, "expected colours from 0 to 1, found others");
      colours[static_cast<std::size_t>(i)][static_cast<std::size_t>(c)] =
          static_cast<std::uint8_t>(value + .5);
    }
  });
  return colours;
}

std::vector<Triangle> triangles_of(const NamedArray& given, std::size_t size) {
  check_whole(given);
  check_shape<3>(given);
  std::vector<Triangle> triangles;
  triangles.reserve(static_cast<std::size_t>(given.array.shape(0)));
  for_each_row(given, [&](py::ssize_t i, const auto& at) {
    Triangle t;
    for (int c = 0; c < 3; ++c)
      t[static_cast<std::size_t>(c)] = index_of(given, i, static_cast<std::int64_t>(at(i, c)), size);
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) triangles.push_back(t);
  });
  if (triangles.empty()) raise_input(given.name, "", "expected triangles of three points, found none");
  return triangles;
}

std::vector<Index> indices_of(const NamedArray& given, std::size_t size) {
  check_whole(given);
  if (given.array.ndim() != 1) raise_shape(given, "(N,)");
  std::vector<Index> indices(static_cast<std::size_t>(given.array.shape(0)));
  for_each_row(given, [&](py::ssize_t i, const auto& at) {
    indices[static_cast<std::size_t>(i)] = index_of(given, i, static_cast<std::int64_t>(at(i, 0)), size);
  });
  return indices;
}

std::vector<float> weights_of(const NamedArray& given, std::size_t size) {
  if (given.array.ndim() != 1) raise_shape(given, "(N,)");
  check_rows(given, size);
  std::vector<float> weights(size);
  for_each_row(given, [&](py::ssize_t i, const auto& at) {
    const auto weight = static_cast<float>(at(i, 0));
    if (!(weight > 0 && weight <= 1)) raise_row(given, i, cat("expected a weight in (0, 1], found ", weight));
    weights[static_cast<std::size_t>(i)] = weight;
  });
  return weights;
}

DepthImage depth_image_of(const NamedArray& given) {
  const py::array& array = given.array;
  constexpr py::ssize_t least = 16, most_pixels = py::ssize_t{1} << 27;
  if (array.ndim() != 2 || array.shape(0) < least || array.shape(1) < least ||
      array.shape(0) * array.shape(1) > most_pixels)
    raise_shape(given, "(N, 3) points or a depth image of 16 x 16 to 2^27 pixels");
  DepthImage image;
  image.values.resize(static_cast<int>(array.shape(1)), static_cast<int>(array.shape(0)));
  image.step = array.dtype().kind() == 'f' ? 0 : 1;
  image.format = cat("array of ", dtype_text(array));
  with_reader(given, [&](const auto& at) {
    for (int y = 0; y < image.values.height; ++y)
      for (int x = 0; x < image.values.width; ++x) {
        const auto value = static_cast<float>(at(y, x));
        image.values.at(x, y) = std::isfinite(value) ? value : std::numeric_limits<float>::quiet_NaN();
      }
  });
  return image;
}

}  // namespace relievo::python
