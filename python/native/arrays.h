// Converts NumPy arrays to vectors of the library, and results of the library to arrays.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <memory>
#include <string>
#include <vector>

#include "relievo/core/image.h"
#include "relievo/core/types.h"
#include "relievo/scan/depth_image.h"

namespace relievo::python {

namespace py = pybind11;

// An array that a user passed, and its name for error messages.
struct NamedArray {
  const char* name;
  py::array array;
};

// Return the rows of an array of real numbers: integers or floats of any size, in any memory layout. The rows
// are copied once, directly into the library's memory, because other threads may change the array while the
// library works. Raise relievo.Error for another shape or kind, and for a number that is not finite; the
// error names its row.
std::vector<Vec3> points_of(const NamedArray& given);
std::vector<Vec2> plane_points_of(const NamedArray& given);

// Returns the rows as unit vectors. Raises in the same cases as points_of(), and if the number of rows is not
// `size` or a row is all zeros.
std::vector<Vec3f> normals_of(const NamedArray& given, std::size_t size);

// Returns the colours in `size` rows. A row has three values, or four with an opacity, which is ignored.
// 8-bit integers are from 0 to 255, floats from 0 to 1.
std::vector<Colour> colours_of(const NamedArray& given, std::size_t size);

// Return indices of points. Raise unless all are integers from 0 to size - 1. triangles_of() reads three
// indices per row, and leaves out triangles with two equal corners.
std::vector<Triangle> triangles_of(const NamedArray& given, std::size_t size);
std::vector<Index> indices_of(const NamedArray& given, std::size_t size);

// Returns one weight per point. Raises if the number of weights is not `size`, or if a weight is not in
// (0, 1].
std::vector<float> weights_of(const NamedArray& given, std::size_t size);

// Returns a depth image from the rows of a 2-D array. Numbers that are not finite mean missing depths.
DepthImage depth_image_of(const NamedArray& given);

// Returns a read-only array that refers to the numbers of `owner`, without a copy. The array keeps the owner
// alive.
template <typename Number>
py::array view_of(const Number* numbers, std::vector<py::ssize_t> shape, std::shared_ptr<const void> owner) {
  auto kept = std::make_unique<std::shared_ptr<const void>>(std::move(owner));
  const py::capsule base(kept.get(), [](void* p) { delete static_cast<std::shared_ptr<const void>*>(p); });
  (void)kept.release();
  py::array array(py::dtype::of<Number>(), std::move(shape), numbers, base);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

// Returns a read-only array that refers to `rows`, which are points, colours, normals or triangles, without a copy.
template <typename Row>
py::array view_of(const std::vector<Row>& rows, std::shared_ptr<const void> owner) {
  using Number = typename Row::value_type;
  constexpr py::ssize_t columns = sizeof(Row) / sizeof(Number);
  return view_of(reinterpret_cast<const Number*>(rows.data()), {std::ssize(rows), columns}, std::move(owner));
}

// Returns an array that takes over the numbers of a vector, without a copy.
template <typename Number>
py::array array_of(std::vector<Number> numbers, std::vector<py::ssize_t> shape) {
  auto kept = std::make_unique<std::vector<Number>>(std::move(numbers));
  const py::capsule base(kept.get(), [](void* p) { delete static_cast<std::vector<Number>*>(p); });
  const Number* const data = kept.release()->data();
  return py::array(py::dtype::of<Number>(), std::move(shape), data, base);
}

// Returns an image as an array with the axes rows, columns and channels; without the last axis if there is
// one channel.
template <typename Number>
py::array array_of(Image<Number> image) {
  std::vector<py::ssize_t> shape{image.height, image.width};
  if (image.channels > 1) shape.push_back(image.channels);
  return array_of(std::move(image.pixels), std::move(shape));
}

}  // namespace relievo::python
