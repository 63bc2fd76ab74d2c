#include "free_rim.h"

#include <algorithm>

#include "extent.h"
#include "relievo/parallel.h"

namespace relievo {
namespace {

// Slivers alone around a point must not leave it without any pull: of the longer side's square.
constexpr double least_area = 1e-12;

// A third of the area of the triangles around each point.
std::vector<double> areas(const Surface& surface) {
  std::vector<double> area(surface.points.size(), 0.0);
  for (std::size_t t = 0; t < surface.triangulation.triangles.size(); ++t) {
    if (!surface.boundary.is_inside[t]) continue;
    const auto [a, b, c] = surface.triangulation.triangles[t];
    const Vec2 u = (surface.points[b] - surface.points[a]).head<2>(),
               v = (surface.points[c] - surface.points[a]).head<2>();
    for (const Index corner : {a, b, c}) area[corner] += (u.x() * v.y() - u.y() * v.x()) / 6;
  }
  return area;
}

// The diagonal anew, from edges between unknowns and the pull: what held the rim to the base is left out.
void free_the_rim(Eigen::SparseMatrix<double>& A, std::span<const double> pull) {
  std::vector<double> diagonal(pull.begin(), pull.end());
  for (int column = 0; column < A.outerSize(); ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator it(A, column); it; ++it)
      if (it.row() != it.col()) {
        diagonal[static_cast<std::size_t>(it.row())] -= it.value();
        diagonal[static_cast<std::size_t>(it.col())] -= it.value();
      }
  for (int i = 0; i < A.outerSize(); ++i) A.coeffRef(i, i) = diagonal[static_cast<std::size_t>(i)];
}

}  // namespace

FreeRimSystem::FreeRimSystem(HeightEquations equations, std::vector<double> pull, Cholesky factor)
    : equations_(std::move(equations)), pull_(std::move(pull)), factor_(std::move(factor)) {
  is_boundary_.assign(equations_.begin.size() - 1, 1);
  for (const Index i : equations_.free_points) is_boundary_[i] = 0;
}

Result<FreeRimSystem> FreeRimSystem::build(const Surface& surface, double reach) {
  HeightEquations equations =
      height_equations(in_plane(surface.points), surface.triangulation, surface.boundary);
  const std::vector<double> area = areas(surface);
  const double side = longer_side_of(surface.points);
  std::vector<double> pull;
  std::vector<Vec2> positions;
  for (const Index i : equations.free_points) {
    pull.push_back(std::max(area[i], least_area * side * side) / (reach * reach));
    positions.push_back(surface.points[i].head<2>());
  }
  free_the_rim(equations.A, pull);
  Result<Cholesky> factor = Cholesky::factor(equations.A, positions);
  if (!factor) return std::unexpected(factor.error());
  return FreeRimSystem(std::move(equations), std::move(pull), std::move(*factor));
}

double FreeRimSystem::divergence(Index point, std::span<const Vec2f> slopes) const {
  double sum = 0;
  for (Index e = equations_.begin[point]; e < equations_.begin[point + 1]; ++e) {
    const PointLink& link = equations_.edges[e];
    if (is_boundary_[link.other]) continue;
    sum += (slopes[point] + slopes[link.other]).cast<double>().dot(link.pull.cast<double>());
  }
  return sum;
}

std::vector<double> FreeRimSystem::solve(std::span<const Vec2f> slopes,
                                         std::span<const double> levels) const {
  const std::vector<Index>& free_points = equations_.free_points;
  std::vector<double> z(free_points.size());
  parallel_for(z.size(), [&](std::size_t f) {
    const Index i = free_points[f];
    z[f] = (levels.empty() ? 0 : pull_[f] * levels[i]) + (slopes.empty() ? 0 : divergence(i, slopes));
  });
  factor_.solve(z, z);
  std::vector<double> heights(is_boundary_.size(), 0.0);
  for (std::size_t f = 0; f < z.size(); ++f) heights[free_points[f]] = z[f];
  return heights;
}

}  // namespace relievo
