// The data of a Cholesky object: the structure of the factor cut into tasks, its values, and the matrix.
// Tested by tests/solver/cholesky_test.cpp.
#pragma once

#include <memory>

#include "core/memory.h"
#include "relievo/core/types.h"
#include "relievo/solver/cholesky.h"
#include "solver/supernode_panel.h"
#include "solver/supernodes.h"

namespace relievo::solver {

// A run of consecutive columns that one thread works on at a time: either whole subtrees of the assembly tree
// or a single supernode above them. How the tree is cut into tasks depends only on the matrix, not on the
// number of threads.
//
// Each task has a work vector: one number per own column, then one per boundary row. A boundary row is a row
// of the task's supernodes that is a column of a task above. A task writes only to its own work vector; the
// parent fetches the amounts that the task has added to its boundary. So results do not depend on the number
// of threads.
struct Task {
  Index first_column = 0, end_column = 0;
  Index first_node = 0, end_node = 0;      // supernodes
  Index parent = no_index;                 // a task with a higher number
  Index first_child = 0, end_child = 0;    // in `children`
  Index first_boundary = 0, boundary = 0;  // in `boundary` and `to_parent`
  std::size_t work_begin = 0;              // where its work vector begins in the workspace
  std::size_t values = 0, end_values = 0;  // range of its values
  std::size_t rows = 0, end_rows = 0;      // range of its part of `rows`
  bool is_subtree = false;

  Index own() const { return end_column - first_column; }
};

// The largest work vector of a task that is a subtree: positions in it are stored in 16 bits.
inline constexpr Index largest_subtree_work_vector = 0xFFFF;

// The off-diagonal entries of the matrix in compressed sparse rows, by tasks. An entry within a task is
// stored once, at the earlier column; an entry that joins two tasks is stored in both, so that a task can
// form its rows of a product without writing to another task's rows.
struct TaskMatrix {
  std::vector<double> diagonal;
  std::vector<Index> begin = {0};
  std::vector<Index> to;
  // Each entry is value + rest, where `rest` is the rounding error of single precision, so that together they
  // have 48 bits. `rest` is empty if all entries are exact.
  std::vector<float> value;
  std::vector<float> rest;

  double entry(Index e) const {
    return static_cast<double>(value[e]) + (rest.empty() ? 0 : static_cast<double>(rest[e]));
  }
};

struct Cholesky::Factor {
  std::vector<Index> order;  // per column, the unknown eliminated there
  std::vector<Task> tasks;   // children before parents
  std::vector<Index> children;
  std::vector<Index> boundary;   // columns
  std::vector<Index> to_parent;  // row of each boundary column in the parent's work vector
  std::vector<NodeSize> nodes;
  std::vector<std::uint16_t> rows;  // work rows of the supernodes in subtrees, see Subtree
  LargeArray values;                // the panels of W, task after task
  std::size_t value_count = 0, work_count = 0;
  TaskMatrix matrix;
};

// Cuts the structure into tasks. Returns a factor that lacks only its values and its matrix.
std::unique_ptr<Cholesky::Factor> build_task_tree(const Supernodes& supernodes);

// Returns the position of a column in the task's work vector. The column must be one of the task's own or on
// its boundary.
Index work_row(const Cholesky::Factor& factor, const Task& task, Index column);

// The graph of a symmetric matrix, with the matrix entry of each edge and each vertex.
struct WeightedGraph {
  Graph graph;
  std::vector<double> weight, diagonal;
};

// Factors A and writes the matrix and the values into `factor`. Returns no_index, or the first column whose
// pivot shows that A is not positive definite.
Index factorise(const WeightedGraph& A, Cholesky::Factor& factor);

}  // namespace relievo::solver
