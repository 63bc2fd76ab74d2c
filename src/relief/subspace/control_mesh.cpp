#include "relief/subspace/control_mesh.h"

#include "core/disjoint_sets.h"
#include "core/groups.h"
#include "geometry/neighbours.h"
#include "geometry/plane.h"
#include "relievo/core/parallel.h"
#include "scan/jumps.h"

namespace relievo {
namespace {

// Locates points by walking through the triangles, starting from the last triangle found.
class Walker {
 public:
  Walker(std::span<const Vec2> points, const Triangulation& mesh) : points_(points), mesh_(mesh) {}

  // Returns a triangle that contains p, up to rounding; no_index if p is outside the hull.
  Index find(const Vec2& p) {
    for (std::size_t step = 0; step < mesh_.triangles.size(); ++step) {
      const int edge = edge_towards(p);
      if (edge < 0) return at_;
      const Index next = mesh_.neighbours[at_][static_cast<std::size_t>(edge)];
      if (next == no_index) return no_index;
      at_ = next;
    }
    return no_index;
  }

 private:
  // Returns the edge that has p farthest on its outer side; -1 if p is inside of all edges.
  int edge_towards(const Vec2& p) const {
    int found = -1;
    double least = 0;
    for (int i = 0; i < 3; ++i) {
      const Triangle& t = mesh_.triangles[at_];
      const Vec2& a = points_[t[static_cast<std::size_t>(i + 1) % 3]];
      const Vec2& b = points_[t[static_cast<std::size_t>(i + 2) % 3]];
      const double distance = twice_area(a, b, p) / (b - a).norm();
      if (distance < least) least = distance, found = i;
    }
    return found;
  }

  std::span<const Vec2> points_;
  const Triangulation& mesh_;
  Index at_ = 0;
};

std::vector<std::uint8_t> covered(const ControlMesh& mesh, const Surface& surface) {
  const std::vector<Triangle>& triangles = mesh.triangulation.triangles;
  std::vector<double> area(triangles.size(), 0.0);
  if (area.empty()) return {};
  Walker walker(mesh.points, mesh.triangulation);
  for (const Triangle corners : triangles_inside(surface)) {
    const Vec2 a = surface.points[corners[0]].head<2>(), b = surface.points[corners[1]].head<2>(),
               c = surface.points[corners[2]].head<2>();
    const Index found = walker.find((a + b + c) / 3);
    if (found != no_index) area[found] += twice_area(a, b, c);
  }
  std::vector<std::uint8_t> is_inside(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto [a, b, c] = triangles[t];
    is_inside[t] = area[t] > .5 * twice_area(mesh.points[a], mesh.points[b], mesh.points[c]);
  }
  return is_inside;
}

// Returns, per point, whether its height is fixed at 0. That holds for points on the surface's boundary,
// and for points that belong to no inside triangle. A connected component of the mesh may have no such
// point, because the mesh cuts corners. Then the points at the component's edge get height 0.
std::vector<std::uint8_t> fixed_points(const ControlMesh& mesh, std::size_t boundary_points) {
  const std::size_t n = mesh.points.size();
  std::vector<std::uint8_t> is_fixed(n, 0), is_used(n, 0), is_at_edge(n, 0), has_fixed(n, 0);
  std::fill_n(is_fixed.begin(), boundary_points, 1);
  DisjointSets pieces(n);
  for (std::size_t t = 0; t < mesh.triangulation.triangles.size(); ++t) {
    const bool is_inside = mesh.boundary.is_inside[t];
    const auto [a, b, c] = mesh.triangulation.triangles[t];
    for (const Index i : {a, b, c}) (is_inside ? is_used : is_at_edge)[i] = 1;
    if (is_inside) pieces.join(a, b), pieces.join(b, c);
  }
  for (const Index i : mesh.triangulation.hull) is_at_edge[i] = 1;
  for (Index i = 0; i < n; ++i)
    if (is_fixed[i]) has_fixed[pieces.find(i)] = 1;
  for (Index i = 0; i < n; ++i)
    if (!is_used[i] || (is_at_edge[i] && !has_fixed[pieces.find(i)])) is_fixed[i] = 1;
  return is_fixed;
}

// Returns a value proportional to the area of each point in the view plane: twice the area of the point's
// triangles inside the relief. Where the surface is steep, scans have more points per area of the view plane.
// So an unweighted mean over points would give slopes that are too steep.
std::vector<double> shares(const Surface& surface) {
  std::vector<double> share(surface.points.size(), 0.0);
  for (const Triangle corners : triangles_inside(surface)) {
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

// Divides the region into parts of equal area, and picks the point at the middle of each. The points of a
// region are in the order of the surface, in which neighbours follow each other, so the parts are compact.
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

ControlMesh mesh_control_points(const Surface& surface, const ControlPoints& control) {
  ControlMesh mesh;
  for (const Index i : control.points) mesh.points.push_back(surface.points[i].head<2>());
  mesh.triangulation = delaunay(mesh.points);
  mesh.boundary.is_inside = covered(mesh, surface);
  mesh.boundary.is_boundary = fixed_points(mesh, control.boundary_points);
  return mesh;
}

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
    std::fill(own.begin(), own.end(), control.points[c]);  // these remain if the region has no area
    sample(members[c], share, own);
  }
  return samples;
}

}  // namespace relievo
