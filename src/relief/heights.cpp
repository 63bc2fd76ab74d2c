#include "relievo/relief/heights.h"

#include "relief/height_equations.h"

namespace relievo {

Result<HeightSystem> HeightSystem::build(std::span<const Vec2> points, const Triangulation& triangulation,
                                         const Boundary& boundary, std::span<const float> weights) {
  const HeightEquations equations = height_equations(points, triangulation, boundary, weights);
  std::vector<Vec2> positions;
  positions.reserve(equations.free_points.size());
  for (const Index i : equations.free_points) positions.push_back(points[i]);
  RELIEVO_TRY(solver::Cholesky factor, solver::Cholesky::factor(equations.A, positions));
  factor.renumber(equations.free_points);
  return HeightSystem(std::move(factor), SlicedEllMatrix(equations.edges));
}

HeightSystem::HeightSystem(solver::Cholesky factor, SlicedEllMatrix edges)
    : factor_(std::move(factor)), edges_(std::make_unique<SlicedEllMatrix>(std::move(edges))) {}
HeightSystem::HeightSystem(HeightSystem&&) noexcept = default;
HeightSystem& HeightSystem::operator=(HeightSystem&&) noexcept = default;
HeightSystem::~HeightSystem() = default;

std::size_t HeightSystem::size() const {
  return edges_->size();
}

std::size_t HeightSystem::memory() const {
  return factor_.memory() + edges_->memory();
}

// The right-hand side of boundary points is 0, because their coefficients are 0. Solving does not change it,
// and it is their height.
void HeightSystem::solve(std::span<const Vec2> slopes, std::span<double> heights) const {
  edges_->divergence(slopes, heights);
  factor_.solve(heights, heights);
}

void HeightSystem::solve(std::span<const Vec2f> slopes, std::span<float> heights,
                         Workspace& workspace) const {
  edges_->divergence(slopes, heights);
  factor_.solve(heights, heights, workspace);
}

void HeightSystem::solve_in_place(std::span<double> heights) const {
  factor_.solve(heights, heights);
}

void HeightSystem::solve_in_place(std::span<float> heights, Workspace& workspace) const {
  factor_.solve(heights, heights, workspace);
}

}  // namespace relievo
