// A height field over the Delaunay triangulation of points that are added one at a time, with point location and
// walks along segments. Tested by tests/plate/simplify_test.cpp.
#pragma once

#include <optional>
#include <vector>

#include "geometry/delaunay_builder.h"

namespace relievo {

class Approximation {
 public:
  Approximation() = default;
  Approximation(const Approximation&) = delete;  // the triangulation refers to the points
  Approximation& operator=(const Approximation&) = delete;

  // Adds a point above or below a place near a triangle. Calls changed(triangle) for the triangles that are new
  // or have other corners now.
  template <typename Changed>
  void add(const Vec3& point, Index triangle, Changed&& changed) {
    points_.push_back(point);
    plane_.push_back(point.head<2>());
    if (mesh_ && mesh_->insert_added(static_cast<Index>(points_.size() - 1), triangle))
      mesh_->each_around_newest(changed);
  }

  // Triangulates the points that were added up to now, and from now on each point that is added. Returns false
  // if they span no triangle.
  bool start();

  const DelaunayBuilder& mesh() const { return *mesh_; }
  const std::vector<Vec3>& points() const { return points_; }

  // Returns a triangle that contains the place, looked for from triangle `start`; no_index if the place is
  // beyond the hull.
  Index find(const Vec2& place, Index start) const;

  // Returns the other triangle of the edge on which the place lies; no_index if the place is inside t or on
  // the hull.
  Index across(const Vec2& place, Index t) const;

  // Returns the squared slope of a triangle.
  double slope_sq(Index t) const;

  // Returns the height of the plane of a triangle at a place.
  double height(Index t, const Vec2& place) const;

  // Calls f(triangles left and entered, share of the way, height of the approximation) wherever the segment
  // from a to b, which begins in triangle t, crosses an edge.
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
