// Makes surfaces and relief models from clouds. If that is impossible, the test fails.
#pragma once

#include "relievo/relief/relief.h"
#include "relievo/scan/surface.h"
#include "support/results.h"
#include "support/shapes.h"

namespace relievo::test {

inline Surface surface_of(const Cloud& cloud, const View& view = {}) {
  return value_of(find_surface(cloud, view));
}

// Returns the position of a point of the surface in the scan's coordinates.
inline Vec3 place_of(const Surface& surface, std::size_t i) {
  return surface.view.R_view_model.transpose() * surface.points[i] + surface.centre;
}

// Returns heights with waves. On these heights, every brush has an effect.
inline std::vector<double> waves(const Surface& surface) {
  std::vector<double> z;
  for (const Vec3& p : surface.points) z.push_back(1 + .1 * std::sin(40 * p.x()) * std::sin(30 * p.y()));
  return z;
}

inline ReliefModel prepared(const Cloud& cloud, Mode mode = Mode::exact) {
  return value_of(ReliefModel::prepare(surface_of(cloud), nullptr, {mode}));
}

// Returns bumps behind a ring that hides parts of them. The surface has curvature of both signs, a depth
// jump, and an inner hole. Bumps and ring have `n` points each.
inline Cloud bumps_behind_a_ring(std::size_t n = 30000) {
  const Cloud bumps = height_field(
      n, 1.2, [](double x, double y) { return .2 * std::sin(5 * x) * std::cos(4 * y) - 1; },
      [](double x, double y) {
        return Vec2(std::cos(5 * x) * std::cos(4 * y), -.8 * std::sin(5 * x) * std::sin(4 * y));
      });
  return joined(bumps, torus(n, 1.5, .4));
}

}  // namespace relievo::test
