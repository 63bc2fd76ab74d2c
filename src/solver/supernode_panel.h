// Storage of a supernode's panel, the dense part of W that belongs to it, and the products with a panel that
// make up a substitution. Tested by tests/solver/cholesky_test.cpp.
//
// A panel consists of strips of eight columns, each from its own first row down, since the columns of a
// supernode are lower triangular. Rows are padded with zeros to a multiple of four. Within a strip, rows are
// stored in blocks of eight, by columns within a block, with a last block of four if that many rows remain.
// Forward substitution reads the values from front to back, backward substitution from back to front.
#pragma once

#include "solver/frontal_matrix.h"

namespace relievo::solver {

inline constexpr Index strip_width = 8;

inline Index padded_rows(Index width, Index below) {
  return (width + below + 3) / 4 * 4;
}

// Writes the first `width` columns of an inverted front to `values`, rounded to single precision. Returns the
// end of what was written.
float* write_panel(FrontalMatrix& front, Index width, float* values);

struct NodeSize {
  Index width = 0, below = 0;
};

// The largest number of rows of a supernode inside a subtree: the products keep a copy on the stack.
inline constexpr Index largest_subtree_rows = 2048;

// A run of supernodes in postorder. Their columns are consecutive elements of `work`, the task's work vector;
// `rows` lists for each supernode the positions of its rows there, its own columns included, padded to
// padded_rows() with any valid position.
struct Subtree {
  std::span<const NodeSize> nodes;
  const float* values;
  const std::uint16_t* rows;
  float* work;
};

// Forward substitution: replaces the subtree's columns of the work vector by L^-1 times them and updates the
// rows below.
void substitute_forward(const Subtree& subtree);

// Backward substitution: replaces the subtree's columns by L^-T times (columns, rows below). It goes from the
// last supernode to the first, so `values` and `rows` of `end` point behind the last supernode's; `work` is
// as for the forward direction.
void substitute_backward(const Subtree& end);

// Do the same for a single supernode of any size whose rows are the whole work vector, in order. The work
// vector is padded to a multiple of four with finite numbers; `scratch` has room for width + 8 floats.
void substitute_forward(NodeSize node, const float* values, float* work, float* scratch);
void substitute_backward(NodeSize node, const float* values, float* work, float* scratch);

}  // namespace relievo::solver
