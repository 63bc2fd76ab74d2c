// Divides the assembly tree into tasks, the units of parallel execution: subtrees at the bottom, each small
// enough for one thread, and the single supernodes above them. Declared in cholesky_factor.h, tested by
// tests/solver/cholesky_test.cpp.
#include <algorithm>
#include <numeric>

#include "solver/cholesky_factor.h"

namespace relievo::solver {
namespace {

// Returns the largest number of columns of a task that is a subtree. It is so small that there are at least
// about 64 tasks, and so large that few rows belong to two tasks. It is at most 16,384, so that positions in
// a work vector fit into 16 bits.
Index subtree_limit(std::size_t columns) {
  return static_cast<Index>(std::clamp<std::size_t>(columns / 64, 1024, 16384));
}

class TaskTreeBuilder {
 public:
  explicit TaskTreeBuilder(const Supernodes& nodes)
      : nodes_(nodes), limit_(subtree_limit(nodes.order.size())) {}

  std::unique_ptr<Cholesky::Factor> build() {
    result_ = std::make_unique<Cholesky::Factor>();
    result_->order = nodes_.order;
    for (Index s = 0; s < nodes_.size(); ++s) result_->nodes.push_back({nodes_.width(s), nodes_.below(s)});
    mark_supernodes_above();
    make_tasks();
    sort_by_height();
    link();
    assign_storage();
    return std::move(result_);
  }

 private:
  // Marks the supernodes whose subtree is too large for one task, and all their ancestors. A single supernode
  // with too many rows counts as too large, too, because its products would not fit on the stack.
  void mark_supernodes_above() {
    const Index n = nodes_.size();
    std::vector<Index> columns(n, 0);
    begin_.resize(n);
    is_above_.assign(n, 0);
    for (Index s = 0; s < n; ++s) {
      if (columns[s] == 0) begin_[s] = s;
      columns[s] += nodes_.width(s);
      const Index rows = nodes_.width(s) + nodes_.below(s);
      if (columns[s] > limit_ || rows > largest_subtree_rows) is_above_[s] = 1;
      const Index p = nodes_.parent[s];
      if (p == no_index) continue;
      if (columns[p] == 0) begin_[p] = begin_[s];
      columns[p] += columns[s];
      if (is_above_[s]) is_above_[p] = 1;
    }
  }

  // Makes the tasks. Neighbouring subtrees under one parent share a task, as long as their columns stay below
  // the limit and 16 bits suffice for positions in their work vector.
  void make_tasks() {
    for (Index s = 0; s < nodes_.size(); ++s) {
      const Index p = nodes_.parent[s];
      if (!is_above_[s] && p != no_index && !is_above_[p]) continue;
      const bool joins = !is_above_[s] && !tasks_.empty() && tasks_.back().is_subtree && last_parent_ == p &&
                         nodes_.first[s + 1] - tasks_.back().first_column <= limit_ &&
                         rows_so_far_ + nodes_.below(s) <= largest_subtree_work_vector - limit_;
      if (!joins) {
        tasks_.push_back({});
        tasks_.back().first_node = is_above_[s] ? s : begin_[s];
        tasks_.back().first_column = nodes_.first[tasks_.back().first_node];
        tasks_.back().is_subtree = !is_above_[s];
        rows_so_far_ = 0;
      }
      rows_so_far_ += nodes_.below(s);
      tasks_.back().end_node = s + 1;
      tasks_.back().end_column = nodes_.first[s + 1];
      last_parent_ = p;
    }
  }

  Index parent_task(const Task& task, std::span<const Index> task_of) const {
    const Index p = nodes_.parent[task.end_node - 1];
    return p == no_index ? no_index : task_of[p];
  }

  std::vector<Index> tasks_of_nodes() const {
    std::vector<Index> task_of(nodes_.size());
    for (Index t = 0; t < tasks_.size(); ++t)
      std::fill(task_of.begin() + tasks_[t].first_node, task_of.begin() + tasks_[t].end_node, t);
    return task_of;
  }

  // Sorts the tasks by their height in the tree. Threads take tasks in this order. Tasks of the same height
  // do not depend on each other, so the many leaves keep all threads busy, and a task rarely waits for its
  // children. The sort is stable, so the order is reproducible.
  void sort_by_height() {
    const std::vector<Index> task_of = tasks_of_nodes();
    std::vector<Index> height(tasks_.size(), 0), sequence(tasks_.size());
    for (Index t = 0; t < tasks_.size(); ++t)
      if (const Index p = parent_task(tasks_[t], task_of); p != no_index)
        height[p] = std::max(height[p], height[t] + 1);
    std::iota(sequence.begin(), sequence.end(), Index{0});
    std::stable_sort(sequence.begin(), sequence.end(),
                     [&](Index a, Index b) { return height[a] < height[b]; });
    for (const Index t : sequence) result_->tasks.push_back(tasks_[t]);
    tasks_ = result_->tasks;
  }

  void link() {
    const std::vector<Index> task_of = tasks_of_nodes();
    std::vector<Index> next(tasks_.size() + 1, 0);
    for (Task& task : result_->tasks) {
      task.parent = parent_task(task, task_of);
      if (task.parent != no_index) ++next[task.parent + 1];
    }
    std::partial_sum(next.begin(), next.end(), next.begin());
    result_->children.resize(next.back());
    for (Index t = 0; t < tasks_.size(); ++t) {
      result_->tasks[t].first_child = next[t];
      result_->tasks[t].end_child = next[t + 1];
    }
    for (Index t = 0; t < tasks_.size(); ++t)
      if (const Index p = result_->tasks[t].parent; p != no_index) result_->children[next[p]++] = t;
  }

  // Assigns to each task its parts of the shared arrays: boundary, work vector and values.
  void assign_storage() {
    // All boundaries are found first, because the parent's boundary decides where a row is in the parent's work
    // vector.
    for (Task& task : result_->tasks) find_boundary(task);
    for (Task& task : result_->tasks) {
      find_rows_in_parent(task);
      if (task.is_subtree) find_rows(task);
      // The substitutions of a single supernode copy the elements of its columns. The copy is padded to
      // vectors of eight.
      const Index scratch = task.is_subtree ? 0 : task.own() + 8;
      task.work_begin = result_->work_count;
      // The size is rounded up to whole cache lines of 16 floats, with at least eight floats of padding, so that no
      // two threads write to the same line.
      result_->work_count += (task.own() + task.boundary + scratch + 23) / 16 * 16;
      task.values = result_->value_count;
      for (Index s = task.first_node; s < task.end_node; ++s)
        result_->value_count += panel_floats(nodes_.width(s), nodes_.below(s));
      task.end_values = result_->value_count;
    }
  }

  void find_boundary(Task& task) {
    std::vector<Index> rows;
    for (Index s = task.first_node; s < task.end_node; ++s)
      for (const Index row : nodes_.rows_of(s))
        if (row >= task.end_column) rows.push_back(row);
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    task.first_boundary = static_cast<Index>(result_->boundary.size());
    task.boundary = static_cast<Index>(rows.size());
    result_->boundary.insert(result_->boundary.end(), rows.begin(), rows.end());
  }

  void find_rows_in_parent(const Task& task) {
    for (Index i = 0; i < task.boundary; ++i)
      result_->to_parent.push_back(
          work_row(*result_, result_->tasks[task.parent], result_->boundary[task.first_boundary + i]));
  }

  // Lists, for each supernode of a subtree, the positions of its rows in the work vector. The list is padded with the
  // supernode's first row, as the products require.
  void find_rows(Task& task) {
    task.rows = result_->rows.size();
    std::vector<std::uint16_t>& rows = result_->rows;
    for (Index s = task.first_node; s < task.end_node; ++s) {
      const auto first = static_cast<std::uint16_t>(nodes_.first[s] - task.first_column);
      const std::size_t padded = rows.size() + padded_rows(nodes_.width(s), nodes_.below(s));
      for (Index i = 0; i < nodes_.width(s); ++i) rows.push_back(static_cast<std::uint16_t>(first + i));
      for (const Index row : nodes_.rows_of(s))
        rows.push_back(static_cast<std::uint16_t>(work_row(*result_, task, row)));
      rows.resize(padded, first);
    }
    task.end_rows = result_->rows.size();
  }

  const Supernodes& nodes_;
  Index limit_;
  std::vector<Index> begin_;  // per supernode: the first supernode of its subtree
  std::vector<std::uint8_t> is_above_;
  std::vector<Task> tasks_;
  Index last_parent_ = no_index;
  std::size_t rows_so_far_ = 0;
  std::unique_ptr<Cholesky::Factor> result_;
};

}  // namespace

Index work_row(const Cholesky::Factor& factor, const Task& task, Index column) {
  if (column < task.end_column) return column - task.first_column;
  const auto begin = factor.boundary.begin() + task.first_boundary;
  return task.own() + static_cast<Index>(std::lower_bound(begin, begin + task.boundary, column) - begin);
}

std::unique_ptr<Cholesky::Factor> build_task_tree(const Supernodes& supernodes) {
  return TaskTreeBuilder(supernodes).build();
}

}  // namespace relievo::solver
