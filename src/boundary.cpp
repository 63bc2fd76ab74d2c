#include "relievo/boundary.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "depth_buffer.h"
#include "disjoint_sets.h"
#include "neighbours.h"
#include "relievo/parallel.h"

namespace relievo {
namespace {

double circumradius(const Vec2& a, const Vec2& b, const Vec2& c) {
  const Vec2 u = b - a, v = c - a;
  const double twice_area = std::abs(u.x() * v.y() - u.y() * v.x());
  const double product = u.norm() * v.norm() * (c - b).norm();
  return twice_area > 0 ? product / (2 * twice_area) : std::numeric_limits<double>::infinity();
}

class BoundaryFinder {
 public:
  BoundaryFinder(std::span<const Vec2> points, const Triangulation& mesh) : points_(points), mesh_(mesh) {
    radius_.resize(mesh.triangles.size());
    parallel_for(radius_.size(), [&](std::size_t t) {
      const auto [a, b, c] = mesh_.triangles[t];
      radius_[t] = circumradius(points_[a], points_[b], points_[c]);
    });
  }

  std::vector<std::uint8_t> inside(const DepthBuffer& model, double gap, double smallest_hole) const {
    std::vector<std::uint8_t> is_inside(radius_.size());
    parallel_for(radius_.size(),
                 [&](std::size_t t) { is_inside[t] = radius_[t] <= gap || is_covered(t, model); });
    close_small_holes(is_inside, smallest_hole);
    return is_inside;
  }

  std::vector<std::uint8_t> boundary_points(const std::vector<std::uint8_t>& is_inside) const {
    std::vector<std::uint8_t> touches_inside(points_.size(), 0), is_boundary(points_.size(), 0);
    for (std::size_t t = 0; t < is_inside.size(); ++t)
      for (const Index corner : mesh_.triangles[t]) (is_inside[t] ? touches_inside : is_boundary)[corner] = 1;
    for (const Index i : mesh_.hull) is_boundary[i] = 1;
    for (std::size_t i = 0; i < points_.size(); ++i) is_boundary[i] |= !touches_inside[i];
    return is_boundary;
  }

 private:
  bool is_covered(std::size_t t, const DepthBuffer& model) const {
    const auto [a, b, c] = mesh_.triangles[t];
    const Vec2 middle = (points_[a] + points_[b] + points_[c]) / 3;
    return std::isfinite(model.depth(middle.x(), middle.y()));
  }

  // Turns sets of neighbouring outside triangles that do not reach the hull and are narrow to inside.
  void close_small_holes(std::vector<std::uint8_t>& is_inside, double smallest_hole) const {
    const std::size_t n = is_inside.size();
    DisjointSets holes(n + 1);  // number n stands for everything beyond the hull
    for (Index t = 0; t < n; ++t) {
      if (is_inside[t]) continue;
      for (const Index other : mesh_.neighbours[t])
        if (other == no_index)
          holes.join(t, static_cast<Index>(n));
        else if (!is_inside[other])
          holes.join(t, other);
    }
    std::vector<std::uint8_t> is_wide(n + 1, 0);
    is_wide[holes.find(static_cast<Index>(n))] = 1;
    for (Index t = 0; t < n; ++t)
      if (!is_inside[t] && radius_[t] > smallest_hole) is_wide[holes.find(t)] = 1;
    for (Index t = 0; t < n; ++t)
      if (!is_inside[t] && !is_wide[holes.find(t)]) is_inside[t] = 1;
  }

  std::span<const Vec2> points_;
  const Triangulation& mesh_;
  std::vector<double> radius_;
};

// Where anything of the model lies, from whichever side it is seen.
DepthBuffer cover_of(const Cloud& whole, const Spacing& spacing) {
  std::vector<Disc> discs(whole.size());
  parallel_for(whole.size(), [&](std::size_t i) {
    const double radius =
        std::clamp(static_cast<double>(spacing.local[i]), .25 * spacing.rho, 4 * spacing.rho);
    discs[i] = {whole.points[i], whole.normals[i], radius};
  });
  DepthBuffer buffer(bounds(whole), .5 * spacing.rho);
  buffer.splat(discs);
  return buffer;
}

std::vector<float> distances_to(std::span<const Vec2> points, const std::vector<std::uint8_t>& is_boundary) {
  std::vector<Vec2> targets;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (is_boundary[i]) targets.push_back(points[i]);
  const KdTree<Vec2> tree(targets);
  std::vector<float> distance(points.size(), std::numeric_limits<float>::infinity());
  parallel_for(points.size(), [&](std::size_t i) {
    Index nearest;
    double distance_sq;
    if (tree.nearest(points[i], 1, &nearest, &distance_sq))
      distance[i] = static_cast<float>(std::sqrt(distance_sq));
  });
  return distance;
}

}  // namespace

Boundary find_boundary(std::span<const Vec2> points, const Triangulation& triangulation, const Cloud& whole,
                       const Spacing& spacing, const BoundaryOptions& options) {
  const BoundaryFinder finder(points, triangulation);
  const double rho = spacing.rho;
  Boundary boundary;
  boundary.is_inside =
      finder.inside(cover_of(whole, spacing), options.gap * rho, options.smallest_hole * rho);
  boundary.is_boundary = finder.boundary_points(boundary.is_inside);
  boundary.distance = distances_to(points, boundary.is_boundary);
  return boundary;
}

}  // namespace relievo
