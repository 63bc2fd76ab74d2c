// Substitution and refinement.
#include <algorithm>
#include <cmath>

#include "cholesky_factor.h"
#include "relievo/core/parallel.h"

namespace relievo {

struct Cholesky::Workspace::Storage {
  std::vector<float> segments;
  BlockFlags done;
  std::vector<double> solution, residual;  // by place in the order
  std::vector<double> largest;             // of the residual, per task
};

Cholesky::Workspace::Workspace(std::unique_ptr<Storage> storage) : storage_(std::move(storage)) {}
Cholesky::Workspace::Workspace(Workspace&&) noexcept = default;
Cholesky::Workspace& Cholesky::Workspace::operator=(Workspace&&) noexcept = default;
Cholesky::Workspace::~Workspace() = default;

std::size_t Cholesky::Workspace::memory() const {
  const auto& [segments, done, solution, residual, largest] = *storage_;
  return segments.size() * sizeof(float) +
         (solution.size() + residual.size() + largest.size()) * sizeof(double);
}

namespace {

using Factor = Cholesky::Factor;

// Both directions, one task at a time.
struct Substitution {
  const Factor& factor;
  std::vector<float>& segments;

  float* segment(const Task& task) const { return segments.data() + task.segment; }
  float* scratch(const Task& task) const { return segment(task) + (task.own() + task.boundary + 7) / 8 * 8; }

  std::span<const NodeSize> nodes(const Task& task) const {
    return {factor.nodes.data() + task.first_node, factor.nodes.data() + task.end_node};
  }

  void fetch_from_children(const Task& task) const {
    float* to = segment(task);
    for (Index c = task.first_child; c < task.end_child; ++c) {
      const Task& child = factor.tasks[factor.children[c]];
      const float* from = segment(child) + child.own();
      const Index* place = factor.to_parent.data() + child.first_boundary;
      for (Index i = 0; i < child.boundary; ++i) to[place[i]] += from[i];
    }
  }

  void fetch_from_parent(const Task& task) const {
    if (task.parent == no_index) return;
    const float* from = segment(factor.tasks[task.parent]);
    const Index* place = factor.to_parent.data() + task.first_boundary;
    float* to = segment(task) + task.own();
    for (Index i = 0; i < task.boundary; ++i) to[i] = from[place[i]];
  }

  void forward(const Task& task) const {
    std::fill_n(segment(task) + task.own(), task.boundary, 0.0F);
    fetch_from_children(task);
    const float* values = factor.values.get() + task.values;
    if (task.is_subtree)
      substitute_forward({nodes(task), values, factor.rows.data() + task.rows, segment(task)});
    else
      substitute_forward(nodes(task)[0], values, segment(task), scratch(task));
  }

  void backward(const Task& task) const {
    fetch_from_parent(task);
    if (task.is_subtree) {
      substitute_backward({nodes(task), factor.values.get() + task.end_values,
                           factor.rows.data() + task.end_rows, segment(task)});
    } else {
      substitute_backward(nodes(task)[0], factor.values.get() + task.values, segment(task), scratch(task));
    }
  }
};

// load(place) is an element of the right-hand side, store(place, value) takes one of the solution. One
// parallel call: the tasks upwards, then downwards.
template <typename Load, typename Store>
void substitute(const Substitution& s, BlockFlags& done, Load&& load, Store&& store) {
  const std::size_t n = s.factor.tasks.size();
  const auto up = [&](std::size_t t) {
    const Task& task = s.factor.tasks[t];
    for (Index c = task.first_child; c < task.end_child; ++c) done.wait(s.factor.children[c]);
    float* own = s.segment(task);
    for (Index i = 0; i < task.own(); ++i) own[i] = load(task.first_column + i);
    s.forward(task);
  };
  const auto down = [&](std::size_t t) {
    const Task& task = s.factor.tasks[t];
    done.wait(task.parent == no_index ? t : 2 * n - 1 - task.parent);
    s.backward(task);
    const float* own = s.segment(task);
    for (Index i = 0; i < task.own(); ++i) store(task.first_column + i, own[i]);
  };
  done.reset();
  parallel_for(
      2 * n,
      [&](std::size_t block) {
        block < n ? up(block) : down(2 * n - 1 - block);
        done.set(block);
      },
      1);
}

// r = b - A x over the rows of a task; r holds b.
void subtract_product(const TaskMatrix& A, const Task& task, std::span<const double> x, std::span<double> r) {
  for (Index j = task.first_column; j < task.end_column; ++j) {
    double sum = A.diagonal[j] * x[j];
    for (Index e = A.begin[j]; e < A.begin[j + 1]; ++e) {
      const Index i = A.to[e];
      const double entry = A.entry(e);
      sum += entry * x[i];
      if (i >= task.first_column && i < task.end_column) r[i] -= entry * x[j];
    }
    r[j] -= sum;
  }
}

// Keeps the substitution in the range of single precision, whatever the unit of the right-hand side.
double unit_of(double largest) {
  return largest > 0 && std::isfinite(largest) ? std::ldexp(1.0, std::ilogb(largest)) : 1;
}

}  // namespace

Cholesky::Workspace Cholesky::make_workspace() const {
  auto storage = std::make_unique<Workspace::Storage>();
  storage->segments.assign(factor_->segment_count, 0.0F);
  storage->done = BlockFlags(2 * factor_->tasks.size());
  return Workspace(std::move(storage));
}

void Cholesky::solve(std::span<const float> b, std::span<float> x, Workspace& workspace) const {
  const std::vector<Index>& order = factor_->order;
  Workspace::Storage& w = *workspace.storage_;
  substitute(
      Substitution{*factor_, w.segments}, w.done, [&](Index i) { return b[order[i]]; },
      [&](Index i, float value) { x[order[i]] = value; });
}

namespace {

// The refinement of one solution, in the order of elimination.
struct Refinement {
  const Factor& factor;
  std::vector<float>& segments;
  BlockFlags& done;
  std::vector<double>&solution, &residual, &largest;

  // The residual of an x of 0 is b. Returns its largest element.
  double start(std::span<const double> b) const {
    return for_each_task([&](const Task& task) {
      for (Index i = task.first_column; i < task.end_column; ++i) {
        residual[i] = b[factor.order[i]];
        solution[i] = 0;
      }
    });
  }

  // Returns the largest element of the residual.
  double find_residual(std::span<const double> b) const {
    return for_each_task([&](const Task& task) {
      for (Index i = task.first_column; i < task.end_column; ++i) residual[i] = b[factor.order[i]];
      subtract_product(factor.matrix, task, solution, residual);
    });
  }

  void correct(double largest_residual) const {
    const double unit = unit_of(largest_residual);
    substitute(
        Substitution{factor, segments}, done, [&](Index i) { return static_cast<float>(residual[i] / unit); },
        [&](Index i, float value) { solution[i] += unit * static_cast<double>(value); });
  }

  void read(std::span<const double> x) const {
    parallel_for(solution.size(), [&](std::size_t i) { solution[i] = x[factor.order[i]]; });
  }

  void write(std::span<double> x) const {
    parallel_for(solution.size(), [&](std::size_t i) { x[factor.order[i]] = solution[i]; });
  }

 private:
  template <typename F>
  double for_each_task(F&& f) const {
    parallel_for(
        factor.tasks.size(),
        [&](std::size_t t) {
          const Task& task = factor.tasks[t];
          f(task);
          largest[t] = 0;
          for (Index i = task.first_column; i < task.end_column; ++i)
            largest[t] = std::max(largest[t], std::abs(residual[i]));
        },
        1);
    return largest.empty() ? 0 : *std::max_element(largest.begin(), largest.end());
  }
};

Refinement refinement_in(Cholesky::Workspace::Storage& w, const Factor& factor) {
  w.solution.resize(factor.order.size());
  w.residual.resize(factor.order.size());
  w.largest.resize(factor.tasks.size());
  return {factor, w.segments, w.done, w.solution, w.residual, w.largest};
}

}  // namespace

void Cholesky::refine(std::span<const double> b, std::span<double> x, Workspace& workspace) const {
  const Refinement refinement = refinement_in(*workspace.storage_, *factor_);
  refinement.read(x);
  refinement.correct(refinement.find_residual(b));
  refinement.write(x);
}

void Cholesky::solve(std::span<const double> b, std::span<double> x, Workspace& workspace) const {
  const Refinement refinement = refinement_in(*workspace.storage_, *factor_);
  double last = refinement.start(b), rate = 1;
  const double enough = 1e-13 * last;
  const int most_steps = 6;
  for (int step = 0; step < most_steps && last > enough; ++step) {
    refinement.correct(last);
    // Each step gains as much as the one before: the last residual need not be looked at.
    if (rate * last < enough) break;
    const double now = refinement.find_residual(b);
    if (!(now < last / 4)) break;
    rate = now / last;
    last = now;
  }
  refinement.write(x);
}

void Cholesky::solve(std::span<const double> b, std::span<double> x) const {
  Workspace workspace = make_workspace();
  solve(b, x, workspace);
}

}  // namespace relievo
