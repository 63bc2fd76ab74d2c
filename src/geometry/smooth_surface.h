// A smooth surface through heights over a triangulation. Tested by tests/geometry/smooth_surface_test.cpp.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "relievo/core/types.h"

namespace relievo {

// A surface that interpolates the heights of points over the plane. Its slope is continuous inside each
// sheet, a set of triangles marked as smooth that share edges. Other triangles stay plane, so that the
// surface has a crease along their edges. Each smooth triangle is a Clough-Tocher element of three cubics,
// which reproduces quadratic surfaces. The slope at a point comes from the quadratic that fits the heights of
// up to two rings of smooth triangles around the point. It is limited to the slopes of the triangles that the
// point touches, or a little beyond.
class SmoothSurface {
 public:
  // The height and slope of the surface at a place.
  struct Sample {
    double height = 0;
    Vec2 slope = Vec2::Zero();
  };

  // Keeps views of the points and of the triangles, which are counter-clockwise; both must outlive the
  // surface. `is_smooth` has a flag per triangle.
  SmoothSurface(std::span<const Vec3> points, std::span<const Triangle> triangles,
                std::span<const std::uint8_t> is_smooth);

  // Returns the height and slope of triangle `t` at a place in it, or near it.
  Sample at(Index t, const Vec2& place) const;

 private:
  // Bezier points of a third of a triangle, between two corners a, b and the centre s.
  struct Third {
    double a, b, ab, ba, as, bs, abs;  // ab is near a on the side to b, abs in the middle of the third
  };
  struct Element;
  struct Fan;

  std::vector<std::uint8_t> open_points() const;
  void find_slopes();
  void measure(Fan& fan) const;
  static Vec2 limited(const Vec2& slope, const Fan& fan);
  Element element(Index t) const;
  static Sample de_casteljau(const Third& third, const Vec3& inner, const Vec3& share,
                             const std::array<Vec2, 3>& corners);

  std::span<const Vec3> points_;
  std::span<const Triangle> triangles_;
  std::span<const std::uint8_t> is_smooth_;
  std::vector<Vec2> slopes_;  // per point; 0 at points of no smooth triangle
};

}  // namespace relievo
