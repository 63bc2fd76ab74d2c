// Factors a matrix numerically by the multifrontal method (Duff and Reid 1983). Each supernode assembles a dense
// frontal matrix from its entries of A and the contribution blocks of its children. It eliminates its columns in
// double precision and stores them in single precision. The Schur complement of the remaining rows is the supernode's
// contribution block for its parent. Declared in cholesky_factor.h, tested by tests/solver/cholesky_test.cpp.
#include <algorithm>

#include "core/lists.h"
#include "relievo/core/parallel.h"
#include "solver/cholesky_factor.h"
#include "solver/supernode_panel.h"

namespace relievo::solver {
namespace {

// A pivot smaller than this fraction of its diagonal entry counts as a rounded 0, because double precision
// resolves 1e-16, and the sums over the fill lose about two digits.
constexpr double relative_pivot = 1e-14;

// The lower triangle of a contribution block, packed column by column.
using Packed = std::vector<double>;

class Multifrontal {
 public:
  Multifrontal(const WeightedGraph& A, Cholesky::Factor& factor) : A_(A), factor_(factor) {
    position_.resize(factor.order.size());
    for (Index i = 0; i < position_.size(); ++i) position_[factor.order[i]] = i;
  }

  Index run();

 private:
  class Subtree;

  void fill_matrix();
  void eliminate_supernode(std::size_t t);
  void add_matrix(const Task& task, Index first, Index width, std::span<const Index> slot,
                  FrontalMatrix& front) const;
  void eliminate(std::size_t t, Index first, Index width, FrontalMatrix& front, float*& values);

  const WeightedGraph& A_;
  Cholesky::Factor& factor_;
  std::vector<Index> position_;
  std::vector<Packed> contribution_;  // per task: the contribution block of its boundary rows
  std::vector<Index> failed_;         // per task: the column whose pivot failed
};

// Returns whether the task stores the matrix entry of `column` and `other` in the list of `column`. TaskMatrix states
// the rule.
bool is_kept(const Task& task, Index column, Index other) {
  return other > column || other < task.first_column;
}

void Multifrontal::fill_matrix() {
  TaskMatrix& matrix = factor_.matrix;
  const std::size_t n = position_.size();
  matrix.diagonal.resize(n);
  matrix.begin.assign(n + 1, 0);
  const auto for_each_entry = [&](std::size_t t, auto&& f) {
    const Task& task = factor_.tasks[t];
    for (Index j = task.first_column; j < task.end_column; ++j) {
      const Index unknown = factor_.order[j];
      for (Index e = A_.graph.begin[unknown]; e < A_.graph.begin[unknown + 1]; ++e)
        if (is_kept(task, j, position_[A_.graph.to[e]])) f(j, e);
    }
  };
  parallel_for(
      factor_.tasks.size(),
      [&](std::size_t t) { for_each_entry(t, [&](Index j, Index) { ++matrix.begin[j + 1]; }); }, 1);
  for (std::size_t j = 0; j < n; ++j) matrix.begin[j + 1] += matrix.begin[j];
  matrix.to.resize(matrix.begin[n]);
  matrix.value.resize(matrix.begin[n]);
  const auto rest_of = [](double value) { return value - static_cast<double>(static_cast<float>(value)); };
  if (std::any_of(A_.weight.begin(), A_.weight.end(), [&](double w) { return rest_of(w) != 0; }))
    matrix.rest.resize(matrix.begin[n]);
  parallel_for(
      factor_.tasks.size(),
      [&](std::size_t t) {
        Index column = no_index, next = 0;
        for_each_entry(t, [&](Index j, Index e) {
          if (j != column) column = j, next = matrix.begin[j];
          matrix.to[next] = position_[A_.graph.to[e]];
          matrix.value[next] = static_cast<float>(A_.weight[e]);
          if (!matrix.rest.empty()) matrix.rest[next] = static_cast<float>(rest_of(A_.weight[e]));
          ++next;
        });
      },
      1);
  parallel_for(n, [&](std::size_t j) { matrix.diagonal[j] = A_.diagonal[factor_.order[j]]; });
}

// Adds to the frontal matrix the entries of `width` columns of A; column `first` is the first of them. Row r
// of the work vector corresponds to row slot[r] of the frontal matrix.
void Multifrontal::add_matrix(const Task& task, Index first, Index width, std::span<const Index> slot,
                              FrontalMatrix& front) const {
  const TaskMatrix& matrix = factor_.matrix;
  for (Index c = 0; c < width; ++c) {
    double* column = front.column(c);
    column[c] += matrix.diagonal[first + c];
    for (Index e = matrix.begin[first + c]; e < matrix.begin[first + c + 1]; ++e)
      if (matrix.to[e] > first + c) column[slot[work_row(factor_, task, matrix.to[e])]] += matrix.entry(e);
  }
}

void Multifrontal::eliminate(std::size_t t, Index first, Index width, FrontalMatrix& front, float*& values) {
  std::vector<double> smallest(width);
  for (Index c = 0; c < width; ++c)
    smallest[c] = relative_pivot * std::abs(factor_.matrix.diagonal[first + c]);
  const Index failed = eliminate_columns(front, width, smallest);
  if (failed != no_index) failed_[t] = std::min(failed_[t], first + failed);
  invert_columns(front, width);
  values = write_panel(front, width, values);
}

// Adds a packed triangle to a matrix whose column c begins at column(c). Row i of the triangle is added to
// row slot[i]. Slots ascend, so the sum stays in the lower triangle.
template <typename Column>
void add_packed(const double* from, std::span<const Index> slot, Column&& column) {
  for (std::size_t c = 0; c < slot.size(); ++c) {
    double* to = column(slot[c]);
    for (std::size_t r = c; r < slot.size(); ++r) to[slot[r]] += *from++;
  }
}

double* pack(FrontalMatrix& front, Index width, double* to) {
  for (Index c = width; c < front.rows; ++c)
    to = std::copy(front.column(c) + c, front.column(c) + front.rows, to);
  return to;
}

std::size_t packed_size(std::size_t rows) {
  return rows * (rows + 1) / 2;
}

// Eliminates a task that is a single supernode. Row r of its frontal matrix corresponds to element r of the
// task's work vector.
void Multifrontal::eliminate_supernode(std::size_t t) {
  const Task& task = factor_.tasks[t];
  FrontalMatrix front;
  front.reset(task.own() + task.boundary);
  std::vector<Index> slot = all_indices(front.rows);
  add_matrix(task, task.first_column, task.own(), slot, front);
  for (Index c = task.first_child; c < task.end_child; ++c) {
    const Task& child = factor_.tasks[factor_.children[c]];
    Packed& packed = contribution_[factor_.children[c]];
    add_packed(packed.data(), {factor_.to_parent.data() + child.first_boundary, child.boundary},
               [&](Index column) { return front.column(column); });
    Packed().swap(packed);
  }
  float* values = factor_.values.get() + task.values;
  eliminate(t, task.first_column, task.own(), front, values);
  contribution_[t].resize(packed_size(task.boundary));
  pack(front, task.own(), contribution_[t].data());
}

// Eliminates the supernodes of a subtree in postorder. So the contribution blocks of a supernode's children are on top
// of the stack when the supernode's frontal matrix is assembled.
class Multifrontal::Subtree {
 public:
  Subtree(Multifrontal& outer, std::size_t t)
      : outer_(outer),
        t_(t),
        task_(outer.factor_.tasks[t]),
        contribution_(outer.contribution_[t]),
        slot_(task_.own() + task_.boundary),
        values_(outer.factor_.values.get() + task_.values) {
    contribution_.assign(packed_size(task_.boundary), 0.0);
  }

  void eliminate() {
    const std::uint16_t* rows = outer_.factor_.rows.data() + task_.rows;
    Index first = 0;  // first column of the supernode in the work vector
    for (Index s = task_.first_node; s < task_.end_node; ++s) {
      const auto [width, below] = outer_.factor_.nodes[s];
      eliminate_node(first, width, {rows, width + below});
      rows += padded_rows(width, below);
      first += width;
    }
  }

 private:
  struct Pending {
    std::span<const std::uint16_t>
        rows;  // positions in the work vector; the first is a column of the parent node
    std::size_t begin;
  };

  void eliminate_node(Index first, Index width, std::span<const std::uint16_t> rows) {
    front_.reset(static_cast<Index>(rows.size()));
    for (Index i = 0; i < rows.size(); ++i) slot_[rows[i]] = i;
    outer_.add_matrix(task_, task_.first_column + first, width, slot_, front_);
    while (!pending_.empty() && pending_.back().rows[0] < first + width) add_child();
    outer_.eliminate(t_, task_.first_column + first, width, front_, values_);
    const auto below = rows.subspan(width);
    const std::size_t begin = stack_.size();
    stack_.resize(begin + packed_size(below.size()));
    pack(front_, width, stack_.data() + begin);
    pending_.push_back({below, begin});
    if (below.empty() || below[0] >= task_.own()) add_to_boundary();
  }

  void add_child() {
    child_slots_.clear();
    for (const std::uint16_t row : pending_.back().rows) child_slots_.push_back(slot_[row]);
    add_packed(stack_.data() + pending_.back().begin, child_slots_,
               [&](Index c) { return front_.column(c); });
    pop();
  }

  // Adds the last contribution block of the stack, whose supernode has its parent in another task, to the
  // task's contribution block.
  void add_to_boundary() {
    child_slots_.clear();
    for (const std::uint16_t row : pending_.back().rows) child_slots_.push_back(row - task_.own());
    // In a packed triangle, column c begins with its row c, so row r is r - c elements behind this beginning.
    // The returned pointer is c elements before this beginning, so row r is r elements behind the pointer.
    add_packed(stack_.data() + pending_.back().begin, child_slots_, [&](Index c) {
      return contribution_.data() + std::size_t{c} * task_.boundary - packed_size(c);
    });
    pop();
  }

  void pop() {
    stack_.resize(pending_.back().begin);
    pending_.pop_back();
  }

  Multifrontal& outer_;
  std::size_t t_;
  const Task& task_;
  Packed& contribution_;
  std::vector<Index> slot_, child_slots_;  // slot_: per row of the work vector, the row of front_
  float* values_;
  FrontalMatrix front_;
  std::vector<double> stack_;
  std::vector<Pending> pending_;
};

Index Multifrontal::run() {
  fill_matrix();
  const std::size_t n = factor_.tasks.size();
  factor_.values = make_large_array(factor_.value_count);
  contribution_.resize(n);
  failed_.assign(n, no_index);
  // Children precede their parents in the order of the tasks, so a task waits only for tasks that have
  // started.
  BlockFlags done(n);
  parallel_for(
      n,
      [&](std::size_t t) {
        const Task& task = factor_.tasks[t];
        for (Index c = task.first_child; c < task.end_child; ++c) done.wait(factor_.children[c]);
        task.is_subtree ? Subtree(*this, t).eliminate() : eliminate_supernode(t);
        done.set(t);
      },
      1);
  return *std::min_element(failed_.begin(), failed_.end());
}

}  // namespace

Index factorise(const WeightedGraph& A, Cholesky::Factor& factor) {
  return Multifrontal(A, factor).run();
}

}  // namespace relievo::solver
