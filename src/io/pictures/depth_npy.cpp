// Reads arrays saved by NumPy. Only two-dimensional arrays of numbers are pictures; dimensions of length 1
// are ignored. src/io/npy_points.cpp reads arrays of points.
#include "io/npy.h"
#include "io/pictures/pictures.h"
#include "relievo/core/text.h"

namespace relievo::io {
namespace {

// Returns the error for an array that is neither a picture nor points.
std::unexpected<Error> other_shape(const Source& source, const NpyArray& array) {
  const bool is_by_channels = array.sizes.size() == 3 && array.sizes[0] == 3;
  return source.error(
      {},
      cat("expected an array of rows and columns, found the shape (", printable(array.shape), "); in Python ",
          is_by_channels ? "np.moveaxis(a, 0, -1) makes points of it, and a[0]" : "a[..., 0]",
          " is one of its channels"));
}

}  // namespace

bool is_npy(const Source& source) {
  if (!has_npy_mark(source)) return false;
  const auto array = read_npy_header(source);
  return !array || !array->has_points();
}

Result<DepthImage> read_depth_npy(const Source& source, const PictureChannels&) {
  RELIEVO_TRY(const NpyArray array, read_npy_header(source));
  if (array.sizes.size() != 2) return other_shape(source, array);
  const std::size_t rows = array.sizes[0], columns = array.sizes[1];
  RELIEVO_CHECK(check_room(source, {columns, rows, array.bytes_per_number(), array.data}));
  const bool is_fraction = array.samples.kind == SampleKind::fraction;
  DepthImage image{{}, is_fraction ? 0.0 : 1.0, cat("NPY, ", array.samples.bits, " bits")};
  image.values.resize(static_cast<int>(columns), static_cast<int>(rows));
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t c = 0; c < columns; ++c)
      image.values[r * columns + c] = array.number<float>(source, r, c);
  return image;
}

}  // namespace relievo::io
