// Provides the dense arithmetic of a sparse factorisation: on the frontal matrices of the multifrontal
// method, and on panels. The panel of a supernode is the dense matrix W that invert_columns() makes from the
// supernode's columns of the factor. Substitutions multiply vectors by panels. Tested by
// tests/solver/cholesky_test.cpp.
//
// A panel consists of strips of eight columns. Each strip begins at its own first row, because the columns of
// a supernode form a lower triangle. Zeros are added below the last row until the number of rows is a
// multiple of four. Within a strip, the rows are divided into blocks of eight, and each block is stored
// column by column; if four rows remain, the last block has four. Forward substitution reads the values from
// the first to the last, and backward substitution reads them from the last to the first.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "relievo/core/types.h"

namespace relievo::solver {

// The lower triangle of a symmetric matrix with `rows` rows, stored by columns at a distance of `stride`
// elements. Each column ends with at least three zeros of padding, so that vectors of four can be used.
// Elements above the diagonal never affect a result.
struct FrontalMatrix {
  Index rows = 0, stride = 0;
  std::vector<double> data;

  double* column(Index c) { return data.data() + std::size_t{stride} * c; }
  // Sets all elements to zero, for a matrix with that many rows.
  void reset(Index new_rows);
};

// Factors the first `width` columns, A = L L^T. Subtracts the outer product of these columns of L from the other
// columns, which become the Schur complement. Returns no_index, or the first column whose pivot is not above its
// element of `smallest_pivot`; then the contents are meaningless.
Index eliminate_columns(FrontalMatrix& front, Index width, std::span<const double> smallest_pivot);

// Replaces the first `width` columns [L1; L2] by W = [L1^-1; -L2 L1^-1], which turns substitution with L into
// a product with W.
void invert_columns(FrontalMatrix& front, Index width);

inline constexpr Index strip_width = 8;

inline Index padded_rows(Index width, Index below) {
  return (width + below + 3) / 4 * 4;
}

// Writes the first `width` columns of an inverted frontal matrix to `values`, rounded to single precision.
// Returns the end of the written values.
float* write_panel(FrontalMatrix& front, Index width, float* values);

struct NodeSize {
  Index width = 0, below = 0;
};

// The largest number of rows of a supernode inside a subtree. It is limited because the products copy the
// work vector's elements for all these rows to the stack.
inline constexpr Index largest_subtree_rows = 2048;

// Consecutive supernodes in postorder. Their columns are consecutive elements of `work`, the task's work
// vector. `rows` has a list for each supernode: the positions of its rows in `work`, first those of its own
// columns. Each list is filled up to padded_rows() elements with any valid position.
struct Subtree {
  std::span<const NodeSize> nodes;
  const float* values;
  const std::uint16_t* rows;
  float* work;
};

// Forward substitution: multiplies by L^-1 those elements of the work vector that belong to the subtree's
// columns. Updates the elements of the rows below them.
void substitute_forward(const Subtree& subtree);

// Backward substitution: multiplies the work vector by L^-T. Reads the elements of the rows below the
// subtree, which must be final, and overwrites the elements of its columns. Goes from the last supernode to
// the first. So end.values and end.rows must point just past the values and rows of the last supernode.
// end.work is the same as for the forward direction.
void substitute_backward(const Subtree& end);

// Forward and backward substitution for a single supernode of any size whose rows are the whole work vector, in
// order. The work vector is padded to a multiple of four with finite numbers. `scratch` has width + 8 floats.
void substitute_forward(NodeSize node, const float* values, float* work, float* scratch);
void substitute_backward(NodeSize node, const float* values, float* work, float* scratch);

}  // namespace relievo::solver
