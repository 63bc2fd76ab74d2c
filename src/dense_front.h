// Dense arithmetic on the fronts of a multifrontal factorisation.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "relievo/core/types.h"

namespace relievo {

// The lower triangle of a symmetric matrix of `rows` rows, column by column; the columns are `stride` apart.
// Below the last row of each column there are at least three elements of padding, all 0. What lies above the
// diagonal is never read for a result.
struct Front {
  Index rows = 0, stride = 0;
  std::vector<double> data;

  double* column(Index c) { return data.data() + std::size_t{stride} * c; }
  // Becomes a zero matrix.
  void reset(Index new_rows);
};

// Factors the first `width` columns, A = L L^T, and subtracts their product from the others: the rest of the
// front becomes the Schur complement. Returns the first column whose pivot is not above `smallest_pivot` of
// that column, or no_index; the columns are then worthless.
Index eliminate_columns(Front& front, Index width, std::span<const double> smallest_pivot);

// Replaces the first `width` columns [L1; L2] by W = [L1^-1; -L2 L1^-1]: substitution with L becomes a
// product with W.
void invert_columns(Front& front, Index width);

}  // namespace relievo
