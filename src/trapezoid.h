// How a supernode's trapezoid of W is kept, and the products with it that make up a substitution.
//
// W stands in panels of eight columns, each from its own first row down. Rows are padded with zeros to a
// multiple of four. A panel keeps its rows in blocks of eight, column by column within a block, and one last
// block of four if that many are left. Both directions read it from front to back.
#pragma once

#include "dense_front.h"

namespace relievo {

inline constexpr Index panel_width = 8;

inline Index padded_rows(Index width, Index below) {
  return (width + below + 3) / 4 * 4;
}

// Writes the first `width` columns of an inverted front to `values`; returns the end of what was written.
float* write_trapezoid(Front& front, Index width, float* values);

struct NodeSize {
  Index width = 0, below = 0;
};

// Rows that a supernode inside a subtree may have: the products keep a copy on the stack.
inline constexpr Index largest_subtree_rows = 2048;

// A run of supernodes, each the child of a later one or of none. Their columns have consecutive places in
// `segment`; `rows` are the places of each supernode's rows, its own columns included, padded with any place.
struct Subtree {
  std::span<const NodeSize> nodes;
  const float* values;
  const std::uint16_t* rows;
  float* segment;
};

// segment := L^-1 segment over the subtree's columns, and what that takes from the rows below.
void substitute_forward(const Subtree& subtree);

// The transpose: columns := L^-T (columns, rows below). The pointers of `end` are those behind the last
// supernode, and of the segment that of the first place.
void substitute_backward(const Subtree& end);

// The same for one supernode of any size whose rows are its whole segment, in order. The segment is padded to
// a multiple of four with finite numbers; `scratch` has room for width + 8.
void substitute_forward(NodeSize node, const float* values, float* segment, float* scratch);
void substitute_backward(NodeSize node, const float* values, float* segment, float* scratch);

}  // namespace relievo
