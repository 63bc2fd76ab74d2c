// What a Cholesky owns: the structure of the factor cut into tasks, its values, and the matrix.
#pragma once

#include <memory>

#include "core/large_array.h"
#include "relievo/core/types.h"
#include "relievo/solver/cholesky.h"
#include "solver/supernodes.h"
#include "trapezoid.h"

namespace relievo {

// A run of consecutive columns that one thread works on at a time: either whole subtrees of the assembly
// tree, or a single supernode above them. Their limits depend on the matrix alone.
//
// A task works in a segment of its own: one number per own column, then one per boundary row (rows of its
// supernodes that belong to tasks above). What it adds to its boundary the parent fetches.
struct Task {
  Index first_column = 0, end_column = 0;
  Index first_node = 0, end_node = 0;      // supernodes
  Index parent = no_index;                 // task; always of a higher number
  Index first_child = 0, end_child = 0;    // in `children`
  Index first_boundary = 0, boundary = 0;  // in `boundary` and `to_parent`
  std::size_t segment = 0;                 // its first element in the workspace
  std::size_t values = 0, end_values = 0;  // its values
  std::size_t rows = 0, end_rows = 0;      // its rows in `rows`
  bool is_subtree = false;

  Index own() const { return end_column - first_column; }
};

// Places in a segment of subtrees are kept in 16 bits.
inline constexpr Index largest_subtree_segment = 0xFFFF;

// The lower triangle by tasks. Entries within a task stand once, at the earlier column; entries that join two
// tasks stand at both, so that a product needs no other task's rows.
struct TaskMatrix {
  std::vector<double> diagonal;
  std::vector<Index> begin = {0};
  std::vector<Index> to;
  std::vector<float> value;  // and what single precision leaves of it; empty if it leaves nothing anywhere
  std::vector<float> rest;

  double entry(Index e) const {
    return static_cast<double>(value[e]) + (rest.empty() ? 0 : static_cast<double>(rest[e]));
  }
};

struct Cholesky::Factor {
  std::vector<Index> order;  // unknown eliminated in this place
  std::vector<Task> tasks;   // children before parents
  std::vector<Index> children;
  std::vector<Index> boundary;   // columns
  std::vector<Index> to_parent;  // where each stands in the parent's segment
  std::vector<NodeSize> nodes;
  std::vector<std::uint16_t> rows;  // of supernodes in subtrees, see Subtree
  LargeArray values;                // trapezoids of W, task after task, see trapezoid.h
  std::size_t value_count = 0, segment_count = 0;
  TaskMatrix matrix;
};

// Cuts the structure into tasks; everything but the values and the matrix.
std::unique_ptr<Cholesky::Factor> lay_out(const Supernodes& supernodes);

// Graph of a matrix whose lower triangle is read, with the entry of each edge.
struct WeightedGraph {
  Graph graph;
  std::vector<double> weight, diagonal;
};

// Fills the matrix and the values. Returns the unknown at which the matrix proves not to be positive
// definite, or no_index.
Index factorise(const WeightedGraph& A, Cholesky::Factor& factor);

}  // namespace relievo
