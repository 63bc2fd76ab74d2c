#include "picture/bent_points.h"

#include <Eigen/Geometry>

#include "relievo/core/parallel.h"

namespace relievo {

BentPoints::BentPoints(const Wrap& wrap, std::span<const Vec2> places) : wrap_(wrap), points_(places.size()) {
  constexpr double step_mm = .01;  // distance between the two positions from which a derivative is computed
  const auto out_at = [&](const Vec2& p) -> Vec3 { return wrap.at(p, 1) - wrap.at(p, 0); };
  parallel_for(places.size(), [&](std::size_t i) {
    const Vec2 p = places[i], x(step_mm / 2, 0), y(0, step_mm / 2);
    points_[i] = {wrap.at(p, 0).cast<float>(),
                  out_at(p).cast<float>(),
                  ((wrap.at(p + x, 0) - wrap.at(p - x, 0)) / step_mm).cast<float>(),
                  ((wrap.at(p + y, 0) - wrap.at(p - y, 0)) / step_mm).cast<float>(),
                  ((out_at(p + x) - out_at(p - x)) / step_mm).cast<float>(),
                  ((out_at(p + y) - out_at(p - y)) / step_mm).cast<float>()};
  });
}

// The normal is perpendicular to the derivatives of the relief's position with respect to x and y. Both derivatives are
// multiplied by the z of the flat normal. That replaces the slopes of the flat relief by minus the x and y of this
// normal, without a division.
Vec3f BentPoints::normal(std::size_t i, float height_mm, const Vec3f& flat) const {
  const Point& p = points_[i];
  const Vec3f by_x = flat.z() * (p.at_by_x + height_mm * p.out_by_x) - flat.x() * p.out;
  const Vec3f by_y = flat.z() * (p.at_by_y + height_mm * p.out_by_y) - flat.y() * p.out;
  return by_x.cross(by_y).normalized();
}

}  // namespace relievo
