#include "relief/stroke_fields.h"

#include <algorithm>

#include "core/lists.h"
#include "geometry/edges.h"
#include "relief/edge_weight.h"
#include "scan/jumps.h"

namespace relievo {
namespace {

std::vector<float> point_areas(const Surface& surface) {
  std::vector<float> areas(surface.points.size(), 0);
  for (const auto [a, b, c] : triangles_inside(surface)) {
    const Vec3 ab = surface.points[b] - surface.points[a], ac = surface.points[c] - surface.points[a];
    const auto third = static_cast<float>((ab.x() * ac.y() - ab.y() * ac.x()) / 6);
    for (const Index i : {a, b, c}) areas[i] += third;
  }
  return areas;
}

}  // namespace

SurfaceLinks surface_links(const Surface& surface) {
  const auto edges = weighted_links(surface, [&](const TriangleSide& side) {
    return surface.boundary.is_inside[side.triangle] && !is_jump(surface, side.from, side.to);
  });
  auto links = grouped<SurfaceLinks::Link>(static_cast<Index>(surface.points.size()), [&](auto&& add) {
    for (const auto& [low, high, weight] : edges) {
      add(low, SurfaceLinks::Link{high, weight});
      add(high, SurfaceLinks::Link{low, weight});
    }
  });
  return {std::move(links), point_areas(surface)};
}

// The blurred heights g of the heights z solve areas (g - z) = -variance L g, one implicit step of diffusion;
// L is the Laplacian of the links. With g = z + e this is the system (areas + variance L) e = -variance L z.
// At the points around the blurred ones e is 0.
template <typename Real>
StrokeBlur<Real>::StrokeBlur(const Surface& surface, const SurfaceLinks& links, std::span<const Index> points,
                             double sigma)
    : points_(points.begin(), points.end()) {
  std::vector<Index> number = places_in(points_, surface.points.size());
  // Two solves, each with half of the variance, approximate a Gaussian better than one solve.
  const double variance = sigma * sigma / 4, least_area = 1e-3 * surface.rho * surface.rho;
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<Vec2> places;
  for (Index i = 0; i < points_.size(); ++i) {
    const double area = std::max(static_cast<double>(links.areas[points_[i]]), least_area);
    double sum = area;
    for (const auto& [to, weight] : links.links[points_[i]]) {
      const double pull = variance * static_cast<double>(weight);
      sum += pull;
      if (number[to] == no_index) {
        number[to] = static_cast<Index>(points_.size() + around_.size());
        around_.push_back(to);
      }
      const Index j = number[to];
      if (j < i) entries.emplace_back(i, j, -pull);
      if (j < i || j >= points_.size()) links_.push_back({i, j, static_cast<Real>(pull)});
    }
    entries.emplace_back(i, i, sum);
    areas_.push_back(static_cast<Real>(area));
    places.emplace_back(surface.points[points_[i]].template head<2>());
  }
  const auto size = static_cast<int>(points_.size());
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  // The factorisation cannot fail, because the matrix is diagonally dominant.
  if (Result<solver::Cholesky> system = solver::Cholesky::factor(matrix, places)) {
    system_.emplace(std::move(*system));
    workspace_.emplace(system_->make_workspace());
  }
}

// Solves twice. The second solve blurs g instead of z.
template <typename Real>
void StrokeBlur<Real>::take(std::span<const Real> z) {
  removed_.assign(points_.size(), 0);
  if (!system_) return;
  std::vector<Real> near, pulled(points_.size() + around_.size(), 0), moved(points_.size());
  near.reserve(pulled.size());
  for (const std::vector<Index>* part : {&points_, &around_})
    for (const Index i : *part) near.push_back(z[i]);
  for (const auto& [a, b, pull] : links_) {
    const Real flow = pull * (near[b] - near[a]);
    pulled[a] += flow, pulled[b] -= flow;
  }
  pulled.resize(points_.size());
  const auto solve = [&] {
    system_->solve(std::span<const Real>(pulled), std::span<Real>(moved), *workspace_);
  };
  solve();
  for (std::size_t i = 0; i < points_.size(); ++i) pulled[i] += areas_[i] * moved[i];
  solve();
  for (std::size_t i = 0; i < points_.size(); ++i) removed_[i] = -moved[i];
}

template class StrokeBlur<float>;
template class StrokeBlur<double>;

}  // namespace relievo
