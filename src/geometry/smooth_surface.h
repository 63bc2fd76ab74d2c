// Interpolates heights over a triangulation by a smooth surface.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "relievo/core/types.h"

namespace relievo {

// A surface that interpolates the heights of points over the plane. `is_smooth` marks smooth triangles; sets
// of them that are connected by edges form sheets. Inside a sheet the slope is continuous. Other triangles
// stay plane, so the surface has creases along their edges. Each smooth triangle is a Clough-Tocher element
// of three cubics, which reproduces quadratic surfaces. The slope at a point comes from a quadratic that is
// fitted to up to two rings of smooth triangles around the point. It is limited to slightly more than the
// range of the slopes of the triangles at the point.
class SmoothSurface {
 public:
  struct Sample {
    double height = 0;
    Vec2 slope = Vec2::Zero();
  };

  // Keeps references to the points and the counter-clockwise triangles; both must outlive the surface. `is_smooth`
  // has a flag per triangle.
  SmoothSurface(std::span<const Vec3> points, std::span<const Triangle> triangles,
                std::span<const std::uint8_t> is_smooth);

  // Returns height and slope at `place`, which must be in triangle `t` or near it.
  Sample at(Index t, const Vec2& place) const;

 private:
  // Bezier points of a third of a triangle, between two corners a, b and the centre s.
  struct Third {
    // ab is the point next to a on the side a-b; abs is the middle point of the third.
    double a, b, ab, ba, as, bs, abs;
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
  std::vector<Vec2> slopes_;  // per point; 0 if the point is in no smooth triangle
};

}  // namespace relievo
