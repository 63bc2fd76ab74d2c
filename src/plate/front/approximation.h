// Defines an approximation of a front: a height field over the Delaunay triangulation of points that are
// added one at a time. It locates points and walks along segments. Tested by tests/plate/simplify_test.cpp.
#pragma once

#include <optional>
#include <vector>

#include "geometry/delaunay_builder.h"

namespace relievo {

class Approximation {
 public:
  Approximation() = default;
  Approximation(const Approximation&) = delete;  // the triangulation has references to the points
  Approximation& operator=(const Approximation&) = delete;

  // Adds a point. `triangle` is a triangle near the point in the plane. Calls changed(triangle) for all
  // triangles that are new or have changed corners.
  template <typename Changed>
  void add(const Vec3& point, Index triangle, Changed&& changed) {
    points_.push_back(point);
    plane_.push_back(point.head<2>());
    if (mesh_ && mesh_->insert_added(static_cast<Index>(points_.size() - 1), triangle))
      mesh_->each_around_newest(changed);
  }

  // Triangulates the points added so far; later points are triangulated as they are added. Returns false if
  // all points are collinear.
  bool start();

  const DelaunayBuilder& mesh() const { return *mesh_; }
  const std::vector<Vec3>& points() const { return points_; }

  // Returns a triangle that contains `place`; no_index if `place` is outside the hull. The search begins at
  // triangle `start`.
  Index find(const Vec2& place, Index start) const;

  // Returns the neighbour of t across the edge that contains `place`; no_index if `place` is inside t or on the hull.
  Index across(const Vec2& place, Index t) const;

  double slope_sq(Index t) const;

  // Returns the height of the plane of triangle t at `place`.
  double height(Index t, const Vec2& place) const;

  // Calls f at each crossing of the segment from a to b with an edge; a must lie in triangle t. The
  // arguments of f are: the triangles before and after the crossing; its position as a share of the
  // segment; the height of the approximation there.
  template <typename F>
  void walk(const Vec2& a, const Vec2& b, Index t, F&& f) const {
    Index from = no_index;
    for (Index steps = 0; steps <= mesh_->size(); ++steps) {
      const auto exit = exit_of(a, b, t, from);
      if (!exit) return;
      const Triangle corners = mesh_->corners(t);
      const Vec3 &p = points_[corners[(*exit + 1) % 3]], &q = points_[corners[(*exit + 2) % 3]];
      const auto side = [&](const Vec3& x) {
        return (b.x() - a.x()) * (x.y() - a.y()) - (b.y() - a.y()) * (x.x() - a.x());
      };
      const double left = side(p), right = side(q), along_edge = left / (left - right);
      const Vec3 crossing = p + along_edge * (q - p);
      const double share = (crossing.head<2>() - a).dot(b - a) / (b - a).squaredNorm();
      from = std::exchange(t, mesh_->neighbour(t, *exit));
      f(std::array{from, t}, share, crossing.z());
      if (t == no_index) return;
    }
  }

 private:
  Index towards(const Vec2& place, Index t, Index from) const;
  std::optional<Index> exit_of(const Vec2& a, const Vec2& b, Index t, Index from) const;

  std::vector<Vec3> points_;
  std::vector<Vec2> plane_;
  std::optional<DelaunayBuilder> mesh_;
};

}  // namespace relievo
