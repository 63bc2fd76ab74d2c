// Defines the data of a Cholesky object: the structure of the factor, divided into tasks, its values, and the matrix.
// Tested by tests/solver/cholesky_test.cpp.
#pragma once

#include <memory>

#include "core/memory.h"
#include "relievo/core/types.h"
#include "relievo/solver/cholesky.h"
#include "solver/dissection.h"
#include "solver/supernode_panel.h"

namespace relievo::solver {

// The columns in elimination order, grouped into supernodes: consecutive columns that are stored as one dense panel.
// The rows of a panel are the supernode's columns and the rows in `rows`. Supernodes are in postorder of the assembly
// tree.
struct Supernodes {
  std::vector<Index> order;        // per column: the vertex that is eliminated there
  std::vector<Index> first = {0};  // supernode s has the columns first[s] up to first[s + 1]
  std::vector<Index> parent;       // supernode that contains the first row below; no_index for a root
  // The rows of supernode s below its own columns, as ascending column indices, are in rows[i] for
  // begin[s] <= i < begin[s + 1].
  std::vector<std::size_t> begin = {0};
  std::vector<Index> rows;

  Index size() const { return static_cast<Index>(parent.size()); }
  Index width(Index s) const { return first[s + 1] - first[s]; }
  Index below(Index s) const { return static_cast<Index>(begin[s + 1] - begin[s]); }
  std::span<const Index> rows_of(Index s) const {
    return {rows.data() + begin[s], rows.data() + begin[s + 1]};
  }
};

// Returns the supernodes for eliminating `graph` in the given order, or in an order with the same fill.
// Consecutive columns with the same structure form a supernode. Supernodes are merged if that makes a
// substitution cheaper, although the merged panel then contains some zeros.
Supernodes analyse(const Graph& graph, std::span<const Index> order);

// Returns the number of floats of a supernode's panel with `width` columns and `below` rows under them, see
// supernode_panel.h.
std::size_t panel_floats(Index width, Index below);

// Consecutive columns that one thread processes without interruption: either whole subtrees of the assembly
// tree, or a single supernode above such subtrees. The division into tasks depends only on the matrix, not on
// the number of threads.
//
// Each task has a work vector with one number per column of its own, then one per boundary row. A boundary
// row is a row of the task's supernodes that is a column of an ancestor of the task. A task writes only to
// its own work vector. In its boundary rows it leaves amounts, which the parent task adds to the parent's
// work vector. So results do not depend on the number of threads.
struct Task {
  Index first_column = 0, end_column = 0;
  Index first_node = 0, end_node = 0;      // range of the task's supernodes
  Index parent = no_index;                 // number of the parent task, always higher than that of this task
  Index first_child = 0, end_child = 0;    // range in Factor::children
  Index first_boundary = 0, boundary = 0;  // start and size of its range in Factor::boundary and to_parent
  std::size_t work_begin = 0;              // start of the task's work vector in the workspace
  std::size_t values = 0, end_values = 0;  // range in Factor::values
  std::size_t rows = 0, end_rows = 0;      // range in Factor::rows
  bool is_subtree = false;

  Index own() const { return end_column - first_column; }
};

// A task that is a subtree has a work vector of at most this size, because positions in it are stored in 16
// bits.
inline constexpr Index largest_subtree_work_vector = 0xFFFF;

// The off-diagonal entries of the matrix in compressed sparse rows, task by task. An entry within a task is
// stored once, at the earlier column. An entry between two tasks is stored in the rows of both tasks. So each
// task can compute its rows of a product with the matrix without writing to the rows of another task.
struct TaskMatrix {
  std::vector<double> diagonal;
  std::vector<Index> begin = {0};
  std::vector<Index> to;
  // Each entry is value + rest; together they have 48 bits. `rest` is the rounding error of `value`. The
  // vector `rest` is empty if all entries are exact.
  std::vector<float> value;
  std::vector<float> rest;

  double entry(Index e) const {
    return static_cast<double>(value[e]) + (rest.empty() ? 0 : static_cast<double>(rest[e]));
  }
};

struct Cholesky::Factor {
  std::vector<Index> order;  // per column: the unknown that is eliminated there
  std::vector<Task> tasks;   // children before parents
  std::vector<Index> children;
  std::vector<Index> boundary;   // columns that are the boundary rows of the tasks
  std::vector<Index> to_parent;  // per boundary column: its row in the parent's work vector
  std::vector<NodeSize> nodes;
  std::vector<std::uint16_t> rows;  // see Subtree::rows
  LargeArray values;                // the panels, task by task
  std::size_t value_count = 0, work_count = 0;
  TaskMatrix matrix;
};

// Divides the structure into tasks. Returns a factor that lacks only its values and its matrix.
std::unique_ptr<Cholesky::Factor> build_task_tree(const Supernodes& supernodes);

// Returns the position of a column in the task's work vector. The column must belong to the task or to its
// boundary.
Index work_row(const Cholesky::Factor& factor, const Task& task, Index column);

// The graph of a symmetric matrix, with the matrix entries of all edges and vertices.
struct WeightedGraph {
  Graph graph;
  std::vector<double> weight, diagonal;
};

// Factors A. Writes the matrix and the values to `factor`. Returns no_index, or the first column whose pivot
// shows that A is not positive definite.
Index factorise(const WeightedGraph& A, Cholesky::Factor& factor);

}  // namespace relievo::solver
