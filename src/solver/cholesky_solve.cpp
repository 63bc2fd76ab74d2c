// Solves with the factor: forward and backward substitution in single precision, with iterative refinement in
// double precision. Tested by tests/solver/cholesky_test.cpp.
#include <algorithm>
#include <cmath>

#include "relievo/core/parallel.h"
#include "solver/cholesky_factor.h"

namespace relievo::solver {

struct Cholesky::Workspace::Storage {
  std::vector<float> work_vectors;
  BlockFlags done;
  std::vector<double> solution, residual;  // in elimination order
  std::vector<double> largest;             // per task: largest element of its residual
};

Cholesky::Workspace::Workspace(std::unique_ptr<Storage> storage) : storage_(std::move(storage)) {}
Cholesky::Workspace::Workspace(Workspace&&) noexcept = default;
Cholesky::Workspace& Cholesky::Workspace::operator=(Workspace&&) noexcept = default;
Cholesky::Workspace::~Workspace() = default;

std::size_t Cholesky::Workspace::memory() const {
  const auto& [work_vectors, done, solution, residual, largest] = *storage_;
  return work_vectors.size() * sizeof(float) +
         (solution.size() + residual.size() + largest.size()) * sizeof(double);
}

namespace {

using Factor = Cholesky::Factor;

// Makes the forward and the backward substitution of a task.
struct Substitution {
  const Factor& factor;
  std::vector<float>& work_vectors;

  float* work_vector(const Task& task) const { return work_vectors.data() + task.work_begin; }
  float* scratch(const Task& task) const {
    return work_vector(task) + (task.own() + task.boundary + 7) / 8 * 8;
  }

  std::span<const NodeSize> nodes(const Task& task) const {
    return {factor.nodes.data() + task.first_node, factor.nodes.data() + task.end_node};
  }

  void fetch_from_children(const Task& task) const {
    float* to = work_vector(task);
    for (Index c = task.first_child; c < task.end_child; ++c) {
      const Task& child = factor.tasks[factor.children[c]];
      const float* from = work_vector(child) + child.own();
      const Index* place = factor.to_parent.data() + child.first_boundary;
      for (Index i = 0; i < child.boundary; ++i) to[place[i]] += from[i];
    }
  }

  void fetch_from_parent(const Task& task) const {
    if (task.parent == no_index) return;
    const float* from = work_vector(factor.tasks[task.parent]);
    const Index* place = factor.to_parent.data() + task.first_boundary;
    float* to = work_vector(task) + task.own();
    for (Index i = 0; i < task.boundary; ++i) to[i] = from[place[i]];
  }

  void forward(const Task& task) const {
    std::fill_n(work_vector(task) + task.own(), task.boundary, 0.0F);
    fetch_from_children(task);
    const float* values = factor.values.get() + task.values;
    if (task.is_subtree)
      substitute_forward({nodes(task), values, factor.rows.data() + task.rows, work_vector(task)});
    else
      substitute_forward(nodes(task)[0], values, work_vector(task), scratch(task));
  }

  void backward(const Task& task) const {
    fetch_from_parent(task);
    if (task.is_subtree) {
      substitute_backward({nodes(task), factor.values.get() + task.end_values,
                           factor.rows.data() + task.end_rows, work_vector(task)});
    } else {
      substitute_backward(nodes(task)[0], factor.values.get() + task.values, work_vector(task),
                          scratch(task));
    }
  }
};

// Solves for one right-hand side. load(column) returns its elements; store(column, value) receives the elements of
// the solution. A single parallel call goes through all tasks forward, from the leaves to the roots, and then back.
// Flags make a task wait only for its children or its parent, so no barrier is needed in between.
template <typename Load, typename Store>
void substitute(const Substitution& s, BlockFlags& done, Load&& load, Store&& store) {
  const std::size_t n = s.factor.tasks.size();
  const auto up = [&](std::size_t t) {
    const Task& task = s.factor.tasks[t];
    for (Index c = task.first_child; c < task.end_child; ++c) done.wait(s.factor.children[c]);
    float* own = s.work_vector(task);
    for (Index i = 0; i < task.own(); ++i) own[i] = load(task.first_column + i);
    s.forward(task);
  };
  const auto down = [&](std::size_t t) {
    const Task& task = s.factor.tasks[t];
    done.wait(task.parent == no_index ? t : 2 * n - 1 - task.parent);
    s.backward(task);
    const float* own = s.work_vector(task);
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

// Subtracts the task's rows of the product A x from r.
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

// Returns a power of two close to the size of the residual. A division by this power is exact. It keeps the
// substitution within the range of single precision, whatever the unit of the right-hand side is.
double unit_of(double largest) {
  return largest > 0 && std::isfinite(largest) ? std::ldexp(1.0, std::ilogb(largest)) : 1;
}

}  // namespace

Cholesky::Workspace Cholesky::make_workspace() const {
  auto storage = std::make_unique<Workspace::Storage>();
  storage->work_vectors.assign(factor_->work_count, 0.0F);
  storage->done = BlockFlags(2 * factor_->tasks.size());
  return Workspace(std::move(storage));
}

void Cholesky::solve(std::span<const float> b, std::span<float> x, Workspace& workspace) const {
  const std::vector<Index>& order = factor_->order;
  Workspace::Storage& w = *workspace.storage_;
  substitute(
      Substitution{*factor_, w.work_vectors}, w.done, [&](Index i) { return b[order[i]]; },
      [&](Index i, float value) { x[order[i]] = value; });
}

namespace {

// Iterative refinement of one solution. Vectors are in elimination order.
struct Refinement {
  const Factor& factor;
  std::vector<float>& work_vectors;
  BlockFlags& done;
  std::vector<double>&solution, &residual, &largest;

  // Sets x to 0 and the residual to b. Returns the largest element of the residual.
  double start(std::span<const double> b) const {
    return for_each_task([&](const Task& task) {
      for (Index i = task.first_column; i < task.end_column; ++i) {
        residual[i] = b[factor.order[i]];
        solution[i] = 0;
      }
    });
  }

  // Computes b - A x. Returns its largest element.
  double find_residual(std::span<const double> b) const {
    return for_each_task([&](const Task& task) {
      for (Index i = task.first_column; i < task.end_column; ++i) residual[i] = b[factor.order[i]];
      subtract_product(factor.matrix, task, solution, residual);
    });
  }

  // Solves for the residual in single precision and adds the result to x.
  void correct(double largest_residual) const {
    const double unit = unit_of(largest_residual);
    substitute(
        Substitution{factor, work_vectors}, done,
        [&](Index i) { return static_cast<float>(residual[i] / unit); },
        [&](Index i, float value) { solution[i] += unit * static_cast<double>(value); });
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
  return {factor, w.work_vectors, w.done, w.solution, w.residual, w.largest};
}

}  // namespace

void Cholesky::solve(std::span<const double> b, std::span<double> x, Workspace& workspace) const {
  const Refinement refinement = refinement_in(*workspace.storage_, *factor_);
  double last = refinement.start(b), rate = 1;
  const double enough = 1e-13 * last;
  const int most_steps = 6;  // each step gains about 7 digits; two steps suffice unless A is ill-conditioned
  for (int step = 0; step < most_steps && last > enough; ++step) {
    refinement.correct(last);
    // All steps reduce the residual by about the same factor. If by this estimate the next residual is small enough,
    // it is not computed.
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

}  // namespace relievo::solver
