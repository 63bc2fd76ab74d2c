// Draws the triangles of a file without the library, to check the library's pictures. It finds out which
// pixels are covered, and the angle between surface and lamp in each of them.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "relievo/core/image.h"
#include "support/read_solid.h"

namespace relievo::test {

// A camera with parallel rays. The rows of `turn` are the axes of the picture in the coordinates of the
// file: to the right, upwards and towards the viewer. `middle` is the point at the centre of the picture.
struct RayCamera {
  Mat3 turn = Mat3::Identity();
  Vec3 middle = Vec3::Zero();
  double pixels_per_mm = 1;
  int width = 1, height = 1;

  // Returns the position of p in pixels, with y downwards. The third coordinate increases towards the viewer.
  Vec3 pixel(const Vec3f& p) const {
    const Vec3 q = pixels_per_mm * (turn * (p.cast<double>() - middle));
    return {width / 2. + q.x(), height / 2. - q.y(), q.z()};
  }
};

// Returns the picture's axes after two rotations. If the angles are positive, the rotation about the vertical
// axis brings the left side nearer to the viewer, and the rotation about the horizontal axis then brings the
// upper side nearer.
inline Mat3 axes_after(double yaw_deg, double pitch_deg) {
  const double a = yaw_deg * std::numbers::pi / 180, b = pitch_deg * std::numbers::pi / 180;
  Mat3 yaw, pitch;
  yaw << std::cos(a), 0, std::sin(a), 0, 1, 0, -std::sin(a), 0, std::cos(a);
  pitch << 1, 0, 0, 0, std::cos(b), -std::sin(b), 0, std::sin(b), std::cos(b);
  return pitch * yaw;
}

// A triangle in pixels of the picture.
struct RayTriangle {
  Vec3 a, u, v;  // a corner, and the edges to the other corners

  double area() const { return u.x() * v.y() - u.y() * v.x(); }
  Vec2 lowest() const { return a.head<2>() + u.cwiseMin(v).cwiseMin(0).head<2>(); }
  Vec2 highest() const { return a.head<2>() + u.cwiseMax(v).cwiseMax(0).head<2>(); }

  // Returns the third coordinate of pixel() at a position on the triangle; minus infinity outside the triangle.
  double depth_at(double x, double y) const {
    const double px = x - a.x(), py = y - a.y();
    const double s = (px * v.y() - py * v.x()) / area(), t = (u.x() * py - u.y() * px) / area();
    const bool is_beside = s < 0 || t < 0 || s + t > 1;
    return is_beside ? -std::numeric_limits<double>::infinity() : a.z() + s * u.z() + t * v.z();
  }
};

// Returns, at the centre of each pixel, the cosine of the angle between the lamp's direction and the surface normal,
// but at least 0. The cosine is NaN where there is no surface. All triangles are tested, and the nearest counts.
inline Image<double> lamp_cosines(const ReadSolid& solid, const RayCamera& camera, const Vec3& to_lamp) {
  constexpr double nowhere = std::numeric_limits<double>::infinity();
  Image<double> nearest = filled_image(camera.width, camera.height, -nowhere), cosines = nearest;
  std::ranges::fill(cosines.pixels, std::numeric_limits<double>::quiet_NaN());
  for (const auto& [a, b, c] : solid.triangles) {
    const Vec3 at = camera.pixel(a);
    const RayTriangle triangle{at, camera.pixel(b) - at, camera.pixel(c) - at};
    if (triangle.area() == 0) continue;
    const Vec2 from = triangle.lowest(), to = triangle.highest();
    const double cosine = (b - a).cross(c - a).cast<double>().normalized().dot(to_lamp.normalized());
    for (int y = std::max(0, static_cast<int>(from.y())); y < std::min<double>(camera.height, to.y()); ++y)
      for (int x = std::max(0, static_cast<int>(from.x())); x < std::min<double>(camera.width, to.x()); ++x) {
        const double depth = triangle.depth_at(x + .5, y + .5);
        if (depth <= nearest.at(x, y)) continue;
        nearest.at(x, y) = depth;
        cosines.at(x, y) = std::max(0., cosine);
      }
  }
  return cosines;
}

}  // namespace relievo::test
