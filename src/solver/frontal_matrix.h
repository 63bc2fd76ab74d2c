// Dense arithmetic on the frontal matrices of a multifrontal factorisation.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "relievo/core/types.h"

namespace relievo::solver {

// The lower triangle of a symmetric matrix of `rows` rows, stored by columns that begin `stride` elements
// apart. Each column ends with at least three elements of padding, all 0, so that it can be processed in
// vectors of four. Elements above the diagonal are never read for a result.
struct FrontalMatrix {
  Index rows = 0, stride = 0;
  std::vector<double> data;

  double* column(Index c) { return data.data() + std::size_t{stride} * c; }
  // Makes it a zero matrix of that many rows.
  void reset(Index new_rows);
};

// Factors the first `width` columns, A = L L^T, and subtracts their outer product from the other columns,
// which become the Schur complement. Returns no_index, or the first column whose pivot is not above its
// element of `smallest_pivot`; the contents are then meaningless.
Index eliminate_columns(FrontalMatrix& front, Index width, std::span<const double> smallest_pivot);

// Replaces the first `width` columns [L1; L2] by W = [L1^-1; -L2 L1^-1], so that substitution with L becomes
// a product with W.
void invert_columns(FrontalMatrix& front, Index width);

}  // namespace relievo::solver
