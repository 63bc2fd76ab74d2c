// Cuts the assembly tree into tasks.
#include <algorithm>
#include <numeric>

#include "cholesky_factor.h"

namespace relievo {
namespace {

// Columns of a subtree that is one task: small enough that tasks outnumber threads, large enough that few
// rows cross from one to another.
Index subtree_limit(std::size_t columns) {
  return static_cast<Index>(std::clamp<std::size_t>(columns / 64, 1024, 16384));
}

class Layout {
 public:
  explicit Layout(const Supernodes& nodes) : nodes_(nodes), limit_(subtree_limit(nodes.order.size())) {}

  std::unique_ptr<Cholesky::Factor> build() {
    result_ = std::make_unique<Cholesky::Factor>();
    result_->order = nodes_.order;
    for (Index s = 0; s < nodes_.size(); ++s) result_->nodes.push_back({nodes_.width(s), nodes_.below(s)});
    find_subtrees();
    make_tasks();
    sort_by_height();
    link();
    place();
    return std::move(result_);
  }

 private:
  void find_subtrees() {
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

  // Neighbouring subtrees under one parent share a task while they are small.
  void make_tasks() {
    for (Index s = 0; s < nodes_.size(); ++s) {
      const Index p = nodes_.parent[s];
      if (!is_above_[s] && p != no_index && !is_above_[p]) continue;
      const bool joins = !is_above_[s] && !tasks_.empty() && tasks_.back().is_subtree && last_parent_ == p &&
                         nodes_.first[s + 1] - tasks_.back().first_column <= limit_ &&
                         rows_so_far_ + nodes_.below(s) <= largest_subtree_segment - limit_;
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

  // All tasks of a height can run side by side, so the widest part of the tree comes first.
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

  void place() {
    // Parents first: where a boundary row stands in the parent's segment depends on the parent's boundary.
    for (Task& task : result_->tasks) find_boundary(task);
    for (Task& task : result_->tasks) {
      find_places_in_parent(task);
      if (task.is_subtree) find_rows(task);
      const Index scratch = task.is_subtree ? 0 : task.own() + 8;
      task.segment = result_->segment_count;
      result_->segment_count += (task.own() + task.boundary + scratch + 23) / 16 * 16;
      task.values = result_->value_count;
      for (Index s = task.first_node; s < task.end_node; ++s)
        result_->value_count += trapezoid_floats(nodes_.width(s), nodes_.below(s));
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

  // Own columns, then boundary.
  Index place_in(const Task& task, Index column) const {
    if (column < task.end_column) return column - task.first_column;
    const auto begin = result_->boundary.begin() + task.first_boundary;
    return task.own() + static_cast<Index>(std::lower_bound(begin, begin + task.boundary, column) - begin);
  }

  void find_places_in_parent(const Task& task) {
    for (Index i = 0; i < task.boundary; ++i)
      result_->to_parent.push_back(
          place_in(result_->tasks[task.parent], result_->boundary[task.first_boundary + i]));
  }

  void find_rows(Task& task) {
    task.rows = result_->rows.size();
    std::vector<std::uint16_t>& rows = result_->rows;
    for (Index s = task.first_node; s < task.end_node; ++s) {
      const auto first = static_cast<std::uint16_t>(nodes_.first[s] - task.first_column);
      const std::size_t padded = rows.size() + padded_rows(nodes_.width(s), nodes_.below(s));
      for (Index i = 0; i < nodes_.width(s); ++i) rows.push_back(static_cast<std::uint16_t>(first + i));
      for (const Index row : nodes_.rows_of(s))
        rows.push_back(static_cast<std::uint16_t>(place_in(task, row)));
      rows.resize(padded, first);
    }
    task.end_rows = result_->rows.size();
  }

  const Supernodes& nodes_;
  Index limit_;
  std::vector<Index> begin_;  // first supernode of the subtree of each
  std::vector<std::uint8_t> is_above_;
  std::vector<Task> tasks_;
  Index last_parent_ = no_index;
  std::size_t rows_so_far_ = 0;
  std::unique_ptr<Cholesky::Factor> result_;
};

}  // namespace

std::unique_ptr<Cholesky::Factor> lay_out(const Supernodes& supernodes) {
  return Layout(supernodes).build();
}

}  // namespace relievo
