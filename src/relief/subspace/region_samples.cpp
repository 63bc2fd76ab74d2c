#include "relief/subspace/region_samples.h"

#include "core/groups.h"
#include "geometry/neighbours.h"
#include "geometry/plane.h"
#include "relievo/core/parallel.h"
#include "relievo/scan/surface.h"

namespace relievo {
namespace {

// Returns, per point, 6 times the area of the relief that belongs to it, a third of each triangle. Scans have
// more points per area of the view plane where the surface is steep, so an unweighted mean over points would
// make slopes too steep.
std::vector<double> shares(const Surface& surface) {
  std::vector<double> share(surface.points.size(), 0.0);
  for (std::size_t t = 0; t < surface.triangulation.triangles.size(); ++t) {
    if (!surface.boundary.is_inside[t]) continue;
    const Triangle& corners = surface.triangulation.triangles[t];
    const Vec2 a = surface.points[corners[0]].head<2>();
    const Vec2 u = surface.points[corners[1]].head<2>() - a, v = surface.points[corners[2]].head<2>() - a;
    for (const Index i : corners) share[i] += cross(u, v);
  }
  return share;
}

std::vector<Index> nearest_control_points(const Surface& surface, const ControlPoints& control) {
  std::vector<Vec2> centres;
  for (const Index i : control.points) centres.push_back(surface.points[i].head<2>());
  const KdTree<Vec2> tree(centres);
  std::vector<Index> nearest(surface.points.size());
  parallel_for(nearest.size(), [&](std::size_t i) {
    double distance_sq;
    tree.nearest(surface.points[i].head<2>(), 1, &nearest[i], &distance_sq);
  });
  return nearest;
}

// Picks the points at the middles of equal parts of the region's area. Points are in an order in which
// neighbours follow each other, so the parts are compact.
void sample(std::span<const Index> region, std::span<const double> share, std::span<Index> samples) {
  double total = 0, sum = 0;
  for (const Index i : region) total += share[i];
  std::size_t s = 0;
  for (const Index i : region) {
    sum += share[i];
    while (s < samples.size() &&
           sum * static_cast<double>(samples.size()) > total * (static_cast<double>(s) + .5))
      samples[s++] = i;
  }
}

}  // namespace

std::vector<Index> sample_regions(const Surface& surface, const ControlPoints& control,
                                  std::size_t per_region) {
  const std::vector<Index> nearest = nearest_control_points(surface, control);
  const std::size_t regions = control.points.size();
  const Groups<Index> members = grouped<Index>(regions, [&](auto&& add) {
    for (Index i = 0; i < nearest.size(); ++i) add(nearest[i], i);
  });

  const std::vector<double> share = shares(surface);
  std::vector<Index> samples(regions * per_region);
  for (std::size_t c = 0; c < regions; ++c) {
    const std::span<Index> own = std::span(samples).subspan(c * per_region, per_region);
    std::fill(own.begin(), own.end(), control.points[c]);  // remains where the region has no area
    sample(members[c], share, own);
  }
  return samples;
}

}  // namespace relievo
