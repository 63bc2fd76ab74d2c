#include "paper/control_points.h"

#include <cmath>

#include "core/lists.h"
#include "geometry/neighbours.h"

namespace relievo::paper {

std::vector<Index> control_points(std::span<const Vec2> points, std::span<const std::uint8_t> is_boundary,
                                  double rho, std::size_t count) {
  std::vector<Index> order = all_indices(points.size());
  if (count >= points.size()) return order;
  std::stable_partition(order.begin(), order.end(), [&](Index i) { return is_boundary[i] != 0; });
  const double radius = std::sqrt(static_cast<double>(points.size()) / static_cast<double>(count)) * rho;
  const KdTree<Vec2> tree(points);
  // Per point: whether it belongs to the region of a chosen point.
  std::vector<std::uint8_t> is_taken(points.size(), 0);
  std::vector<KdTree<Vec2>::Match> region;
  std::vector<Index> chosen;
  for (const Index i : order) {
    if (is_taken[i]) continue;
    chosen.push_back(i);
    tree.within(points[i], radius, region);
    for (const auto& [j, distance_sq] : region) is_taken[j] = 1;
    is_taken[i] = 1;
  }
  return chosen;
}

}  // namespace relievo::paper
