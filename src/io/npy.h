// Reads arrays that NumPy saves (NPY, versions 1 to 3). They are depth images or points.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "io/pictures/samples.h"
#include "io/readers.h"

namespace relievo::io {

// The header of an array with at least one dimension, and access to its numbers.
struct NpyArray {
  std::string_view shape;  // as written in the file: "160, 160"
  SampleFormat samples = {};
  bool is_by_columns = false, is_big_endian = false;
  std::vector<std::size_t> sizes;  // lengths of the dimensions, except those of length 1
  std::size_t data = 0;            // offset of the first number

  unsigned bytes_per_number() const { return samples.bits / 8; }

  // Returns whether the array has points instead of depths. The array has points if its last dimension has 3
  // numbers. It also has points if it is two-dimensional, with up to 9 columns of floating-point numbers and
  // at least 16 times as many rows as columns. Unsigned integers in more than two dimensions are colours, not
  // points.
  bool has_points() const;

  // Returns the number at index `column` of the last dimension. `row` counts through all other dimensions, of
  // which the last changes fastest.
  template <typename Number>
  Number number(const Source& source, std::size_t row, std::size_t column) const {
    const char* const from = source.bytes.data() + data + bytes_per_number() * place(row, column);
    return decode_sample<Number>(samples, whole_number(from, bytes_per_number(), is_big_endian));
  }

 private:
  std::size_t place(std::size_t row, std::size_t column) const;
};

bool has_npy_mark(const Source& source);

// Returns the array's header. Errors: kind input for a truncated header, for a type that is not a real
// number, and for a shape that is not a list of sizes.
Result<NpyArray> read_npy_header(const Source& source);

}  // namespace relievo::io
