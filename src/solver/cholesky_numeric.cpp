// Multifrontal factorisation: each supernode adds up what its children leave over, eliminates its columns in
// double precision, keeps them in single precision and passes the rest on.
#include <algorithm>
#include <atomic>

#include "cholesky_factor.h"
#include "dense_front.h"
#include "relievo/core/parallel.h"
#include "trapezoid.h"

namespace relievo {
namespace {

// A pivot this much smaller than its diagonal entry is rounding left over from 0.
constexpr double relative_pivot = 1e-14;

// Lower triangles of Schur complements, packed column by column.
using Packed = std::vector<double>;

class Numeric {
 public:
  Numeric(const WeightedGraph& A, Cholesky::Factor& factor) : A_(A), factor_(factor) {
    place_.resize(factor.order.size());
    for (Index i = 0; i < place_.size(); ++i) place_[factor.order[i]] = i;
  }

  Index run();

 private:
  class Subtree;

  void fill_matrix();
  void eliminate_supernode(std::size_t t);
  Index place_in(const Task& task, Index column) const;
  void add_matrix(const Task& task, Index first, Index width, std::span<const Index> slot,
                  Front& front) const;
  void eliminate(std::size_t t, Index first, Index width, Front& front, float*& values);

  const WeightedGraph& A_;
  Cholesky::Factor& factor_;
  std::vector<Index> place_;
  std::vector<Packed> left_over_;  // per task, on its boundary
  std::vector<Index> failed_;      // per task, the column whose pivot failed
};

bool is_kept(const Task& task, Index column, Index other) {
  return other > column || other < task.first_column;
}

void Numeric::fill_matrix() {
  TaskMatrix& matrix = factor_.matrix;
  const std::size_t n = place_.size();
  matrix.diagonal.resize(n);
  matrix.begin.assign(n + 1, 0);
  const auto for_each_entry = [&](std::size_t t, auto&& f) {
    const Task& task = factor_.tasks[t];
    for (Index j = task.first_column; j < task.end_column; ++j) {
      const Index unknown = factor_.order[j];
      for (Index e = A_.graph.begin[unknown]; e < A_.graph.begin[unknown + 1]; ++e)
        if (is_kept(task, j, place_[A_.graph.to[e]])) f(j, e);
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
          matrix.to[next] = place_[A_.graph.to[e]];
          matrix.value[next] = static_cast<float>(A_.weight[e]);
          if (!matrix.rest.empty()) matrix.rest[next] = static_cast<float>(rest_of(A_.weight[e]));
          ++next;
        });
      },
      1);
  parallel_for(n, [&](std::size_t j) { matrix.diagonal[j] = A_.diagonal[factor_.order[j]]; });
}

Index Numeric::place_in(const Task& task, Index column) const {
  if (column < task.end_column) return column - task.first_column;
  const auto begin = factor_.boundary.begin() + task.first_boundary;
  return task.own() + static_cast<Index>(std::lower_bound(begin, begin + task.boundary, column) - begin);
}

// `slot` tells where a place of the segment stands in the front.
void Numeric::add_matrix(const Task& task, Index first, Index width, std::span<const Index> slot,
                         Front& front) const {
  const TaskMatrix& matrix = factor_.matrix;
  for (Index c = 0; c < width; ++c) {
    double* column = front.column(c);
    column[c] += matrix.diagonal[first + c];
    for (Index e = matrix.begin[first + c]; e < matrix.begin[first + c + 1]; ++e)
      if (matrix.to[e] > first + c) column[slot[place_in(task, matrix.to[e])]] += matrix.entry(e);
  }
}

void Numeric::eliminate(std::size_t t, Index first, Index width, Front& front, float*& values) {
  std::vector<double> smallest(width);
  for (Index c = 0; c < width; ++c)
    smallest[c] = relative_pivot * std::abs(factor_.matrix.diagonal[first + c]);
  const Index failed = eliminate_columns(front, width, smallest);
  if (failed != no_index) failed_[t] = std::min(failed_[t], first + failed);
  invert_columns(front, width);
  values = write_trapezoid(front, width, values);
}

// Adds a packed triangle whose row i belongs in row slot[i] of the target; slots ascend.
template <typename Column>
void add_packed(const double* from, std::span<const Index> slot, Column&& column) {
  for (std::size_t c = 0; c < slot.size(); ++c) {
    double* to = column(slot[c]);
    for (std::size_t r = c; r < slot.size(); ++r) to[slot[r]] += *from++;
  }
}

double* pack(Front& front, Index width, double* to) {
  for (Index c = width; c < front.rows; ++c)
    to = std::copy(front.column(c) + c, front.column(c) + front.rows, to);
  return to;
}

std::size_t packed_size(std::size_t rows) {
  return rows * (rows + 1) / 2;
}

// A single supernode: its rows are its segment, in order.
void Numeric::eliminate_supernode(std::size_t t) {
  const Task& task = factor_.tasks[t];
  Front front;
  front.reset(task.own() + task.boundary);
  std::vector<Index> slot(front.rows);
  for (Index i = 0; i < front.rows; ++i) slot[i] = i;
  add_matrix(task, task.first_column, task.own(), slot, front);
  for (Index c = task.first_child; c < task.end_child; ++c) {
    const Task& child = factor_.tasks[factor_.children[c]];
    Packed& packed = left_over_[factor_.children[c]];
    add_packed(packed.data(), {factor_.to_parent.data() + child.first_boundary, child.boundary},
               [&](Index column) { return front.column(column); });
    Packed().swap(packed);
  }
  float* values = factor_.values.get() + task.values;
  eliminate(t, task.first_column, task.own(), front, values);
  left_over_[t].resize(packed_size(task.boundary));
  pack(front, task.own(), left_over_[t].data());
}

// The supernodes of a subtree task in postorder: what children leave over lies on top of a stack when their
// parent comes.
class Numeric::Subtree {
 public:
  Subtree(Numeric& numeric, std::size_t t)
      : numeric_(numeric),
        t_(t),
        task_(numeric.factor_.tasks[t]),
        left_over_(numeric.left_over_[t]),
        slot_(task_.own() + task_.boundary),
        values_(numeric.factor_.values.get() + task_.values) {
    left_over_.assign(packed_size(task_.boundary), 0.0);
  }

  void eliminate() {
    const std::uint16_t* rows = numeric_.factor_.rows.data() + task_.rows;
    Index first = 0;  // place of the supernode's first column in the segment
    for (Index s = task_.first_node; s < task_.end_node; ++s) {
      const auto [width, below] = numeric_.factor_.nodes[s];
      eliminate_node(first, width, {rows, width + below});
      rows += padded_rows(width, below);
      first += width;
    }
  }

 private:
  struct Pending {
    std::span<const std::uint16_t> rows;  // places; the parent owns the first
    std::size_t begin;
  };

  void eliminate_node(Index first, Index width, std::span<const std::uint16_t> rows) {
    front_.reset(static_cast<Index>(rows.size()));
    for (Index i = 0; i < rows.size(); ++i) slot_[rows[i]] = i;
    numeric_.add_matrix(task_, task_.first_column + first, width, slot_, front_);
    while (!pending_.empty() && pending_.back().rows[0] < first + width) add_child();
    numeric_.eliminate(t_, task_.first_column + first, width, front_, values_);
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

  // A root: its parent belongs to another task.
  void add_to_boundary() {
    child_slots_.clear();
    for (const std::uint16_t row : pending_.back().rows) child_slots_.push_back(row - task_.own());
    // Packed column c begins with row c.
    add_packed(stack_.data() + pending_.back().begin, child_slots_,
               [&](Index c) { return left_over_.data() + std::size_t{c} * task_.boundary - packed_size(c); });
    pop();
  }

  void pop() {
    stack_.resize(pending_.back().begin);
    pending_.pop_back();
  }

  Numeric& numeric_;
  std::size_t t_;
  const Task& task_;
  Packed& left_over_;
  std::vector<Index> slot_, child_slots_;  // slot_: row of the front, by place in the segment
  float* values_;
  Front front_;
  std::vector<double> stack_;
  std::vector<Pending> pending_;
};

Index Numeric::run() {
  fill_matrix();
  const std::size_t n = factor_.tasks.size();
  factor_.values = make_large_array(factor_.value_count);
  left_over_.resize(n);
  failed_.assign(n, no_index);
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
  return Numeric(A, factor).run();
}

}  // namespace relievo
