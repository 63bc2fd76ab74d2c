#include "relief/own_heights.h"

#include <algorithm>
#include <set>

#include "core/disjoint_sets.h"
#include "core/lists.h"
#include "core/memory.h"
#include "geometry/edges.h"
#include "relievo/scan/surface.h"

namespace relievo {
namespace {

// Returns the Laplacian of the model's points. Points outside of the model have fixed heights.
Eigen::SparseMatrix<double> laplacian_of(std::span<const WeightedLink> links,
                                         const std::vector<Index>& unknown, std::size_t unknowns) {
  std::vector<Eigen::Triplet<double>> entries;
  for (const auto& [a, b, weight] : links) {
    for (const Index end : {a, b})
      if (unknown[end] != no_index) entries.emplace_back(unknown[end], unknown[end], weight);
    if (unknown[a] != no_index && unknown[b] != no_index)
      entries.emplace_back(std::max(unknown[a], unknown[b]), std::min(unknown[a], unknown[b]), -weight);
  }
  const auto size = static_cast<int>(unknowns);
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

// Returns the largest extent in depth among the connected components of the points. Components are measured
// separately, because the letters of a legend may lie at several depths although each letter is level.
double depth_of(const Surface& surface, std::span<const Index> points, std::span<const WeightedLink> links,
                const std::vector<Index>& unknown) {
  DisjointSets sets(points.size());
  for (const auto& [a, b, weight] : links)
    if (unknown[a] != no_index && unknown[b] != no_index) sets.join(unknown[a], unknown[b]);
  std::vector<Box> boxes(points.size());
  double most = 0;
  for (Index i = 0; i < points.size(); ++i) {
    Box& box = boxes[sets.find(i)];
    box.extend(surface.points[points[i]]);
    most = std::max(most, box.size().z());
  }
  return most;
}

}  // namespace

Result<OwnHeights::Model> OwnHeights::model_of(const Surface& surface, float share) {
  std::vector<Index> points, unknown(surface.points.size(), no_index);
  for (Index i = 0; i < surface.points.size(); ++i) {
    if (surface.own_heights[i] != share || surface.boundary.is_boundary[i]) continue;
    unknown[i] = static_cast<Index>(points.size());
    points.push_back(i);
  }
  std::vector<WeightedLink> links = weighted_links(surface, [&](const TriangleSide& side) {
    return surface.boundary.is_inside[side.triangle] &&
           (unknown[side.from] != no_index || unknown[side.to] != no_index);
  });
  std::vector<std::uint8_t> is_edge(unknown.size(), 0);
  for (const auto& [a, b, weight] : links)
    for (const Index end : {a, b}) is_edge[end] = unknown[end] == no_index;
  std::vector<float> distances = pick(distances_to(in_plane(surface.points), is_edge), points);
  const std::vector<Vec2> places = pick(in_plane(surface.points), points);
  RELIEVO_TRY(solver::Cholesky laplacian,
              solver::Cholesky::factor(laplacian_of(links, unknown, points.size()), places));
  laplacian.renumber(points);
  return Model{static_cast<double>(share), depth_of(surface, points, links, unknown),
               std::move(points),          std::move(distances),
               std::move(links),           std::move(laplacian)};
}

Result<OwnHeights> OwnHeights::find(const Surface& surface) {
  OwnHeights found;
  const std::set<float> shares(surface.own_heights.begin(), surface.own_heights.end());
  std::vector<std::pair<double, Model>> by_depth;
  for (const float share : shares) {
    if (share == 0) continue;
    RELIEVO_TRY(Model model, model_of(surface, share));
    double sum = 0;
    for (const Index i : model.points) sum += surface.points[i].z();
    if (!model.points.empty())
      by_depth.emplace_back(sum / static_cast<double>(model.points.size()), std::move(model));
  }
  std::ranges::stable_sort(by_depth, {}, [](const auto& entry) { return entry.first; });
  found.is_own_.resize(surface.own_heights.size(), 0);
  for (auto& [depth, model] : by_depth) {
    for (const Index i : model.points) found.is_own_[i] = 1;
    found.models_.push_back(std::move(model));
  }
  return found;
}

std::size_t OwnHeights::memory() const {
  std::size_t sum = bytes(is_own_);
  for (const Model& model : models_)
    sum += bytes(model.points) + bytes(model.distances) + bytes(model.links) + model.laplacian.memory();
  return sum;
}

template <typename Real>
OwnHeights::Top OwnHeights::raise(std::size_t number, const Limits& limits, std::span<Real> z,
                                  Workspace<Real>& workspace) const {
  const Model& model = models_[number];
  // The height above the harmonic surface has the same Laplacian as the height, and is 0 around the model.
  std::vector<Real>& over = workspace.over;
  over.assign(z.size(), 0);
  for (const auto& [a, b, weight] : model.links) {
    const Real pull = static_cast<Real>(weight) * (z[a] - z[b]);
    over[a] += pull;
    over[b] -= pull;
  }
  model.laplacian.solve(std::span<const Real>(over), std::span<Real>(over), workspace.solvers[number]);
  double highest = 0;
  for (const Index i : model.points) highest = std::max(highest, static_cast<double>(over[i]));
  const double wanted = model.share * limits.height;
  const double scale = std::min(wanted, model.depth) / std::max(highest, 1e-6 * limits.height);
  const double wall = wanted - scale * highest;
  Top top;
  for (std::size_t p = 0; p < model.points.size(); ++p) {
    const Index i = model.points[p];
    const Real behind = z[i] - over[i];
    const double edge = std::min(wall, limits.wall_slope * static_cast<double>(model.distances[p]));
    z[i] = behind + static_cast<Real>(scale * static_cast<double>(over[i]) + edge);
    if (static_cast<double>(z[i]) > top.z) top = {static_cast<double>(z[i]), static_cast<double>(behind)};
  }
  return top;
}

template <typename Real>
void OwnHeights::apply(double height, std::span<Real> z, Workspace<Real>& workspace,
                       double wall_slope) const {
  if (empty()) return;
  for (std::size_t m = workspace.solvers.size(); m < models_.size(); ++m)
    workspace.solvers.push_back(models_[m].laplacian.make_workspace());
  workspace.before.assign(z.begin(), z.end());
  const double wanted = static_cast<double>(*std::ranges::max_element(z));
  // All heights outside of these models are multiplied by one factor. Searches for the factor that keeps the
  // highest height of the relief unchanged. That height is a convex, piecewise linear function of the factor,
  // so Newton's method converges in a few steps. One step is enough if the highest point belongs to none of
  // these models.
  constexpr int most_steps = 8;
  constexpr double tolerance = 1e-6;
  double factor = 1;
  for (int step = 0; step < most_steps; ++step) {
    for (std::size_t i = 0; i < z.size(); ++i) z[i] = static_cast<Real>(factor) * workspace.before[i];
    Top top;
    for (std::size_t i = 0; i < z.size(); ++i)
      if (!is_own_[i] && static_cast<double>(z[i]) > top.z) top.z = top.scaled = static_cast<double>(z[i]);
    for (std::size_t m = 0; m < models_.size(); ++m)
      if (const Top own = raise<Real>(m, {height, wall_slope}, z, workspace); own.z > top.z) top = own;
    if (std::abs(top.z - wanted) <= tolerance * wanted || top.scaled <= tolerance * wanted) return;
    factor *= std::max(.1, 1 + (wanted - top.z) / top.scaled);
  }
}

template void OwnHeights::apply(double, std::span<float>, Workspace<float>&, double) const;
template void OwnHeights::apply(double, std::span<double>, Workspace<double>&, double) const;

}  // namespace relievo
