// Scatters points at random over shapes with closed forms. The random numbers are the same on all machines.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "core/random.h"
#include "relievo/scan/cloud.h"

namespace relievo::test {

class Random : public SplitMix64 {
 public:
  using SplitMix64::SplitMix64;
  double uniform(double low = 0, double high = 1) {
    return low + (high - low) * static_cast<double>(bits() >> 11) * 0x1p-53;
  }
  double gaussian() {
    return std::sqrt(-2 * std::log(1 - uniform())) * std::cos(2 * std::numbers::pi * uniform());
  }
};

inline void add(Cloud& cloud, const Vec3& point, const Vec3& normal) {
  cloud.points.push_back(point);
  cloud.normals.push_back(normal.normalized().cast<float>());
}

// Returns uniformly distributed points on a sphere of the given radius.
inline Cloud sphere(std::size_t n, double radius, std::uint64_t seed = 1) {
  Random random(seed);
  Cloud cloud;
  while (cloud.size() < n) {
    const double z = random.uniform(-1, 1), angle = random.uniform(0, 2 * std::numbers::pi);
    const double r = std::sqrt(1 - z * z);
    const Vec3 normal(r * std::cos(angle), r * std::sin(angle), z);
    add(cloud, radius * normal, normal);
  }
  return cloud;
}

// Returns uniformly distributed points on the lateral surface of a cylinder about the y axis.
inline Cloud cylinder(std::size_t n, double radius, double length, std::uint64_t seed = 2) {
  Random random(seed);
  Cloud cloud;
  while (cloud.size() < n) {
    const double angle = random.uniform(0, 2 * std::numbers::pi);
    const Vec3 normal(std::cos(angle), 0, std::sin(angle));
    add(cloud, radius * normal + random.uniform(-length / 2, length / 2) * Vec3::UnitY(), normal);
  }
  return cloud;
}

// Returns uniformly distributed points on a torus about the z axis. R is the distance from the axis to the
// centre of the tube, and r is the radius of the tube.
inline Cloud torus(std::size_t n, double R, double r, std::uint64_t seed = 3) {
  Random random(seed);
  Cloud cloud;
  while (cloud.size() < n) {
    const double u = random.uniform(0, 2 * std::numbers::pi), v = random.uniform(0, 2 * std::numbers::pi);
    const double ring = R + r * std::cos(v);
    if (random.uniform(0, R + r) > ring) continue;
    const Vec3 normal(std::cos(v) * std::cos(u), std::cos(v) * std::sin(u), std::sin(v));
    add(cloud, ring * Vec3(std::cos(u), std::sin(u), 0) + r * std::sin(v) * Vec3::UnitZ(), normal);
  }
  return cloud;
}

// Returns points of z = f(x, y). They are uniformly distributed in x and y over a square of side 2 * half.
// The normals follow from `gradient`, which returns (df/dx, df/dy).
template <typename F, typename G>
Cloud height_field(std::size_t n, double half, F f, G gradient, std::uint64_t seed = 4) {
  Random random(seed);
  Cloud cloud;
  while (cloud.size() < n) {
    const double x = random.uniform(-half, half), y = random.uniform(-half, half);
    const Vec2 g = gradient(x, y);
    add(cloud, {x, y, f(x, y)}, {-g.x(), -g.y(), 1});
  }
  return cloud;
}

// Returns points of a square of side 2 * half, parallel to the view plane.
inline Cloud sheet(std::size_t n, double half, double z, std::uint64_t seed = 5) {
  return height_field(
      n, half, [z](double, double) { return z; }, [](double, double) { return Vec2(0, 0); }, seed);
}

inline Cloud moved(Cloud cloud, const Vec3& by) {
  for (Vec3& p : cloud.points) p += by;
  return cloud;
}

inline Cloud turned(Cloud cloud, double degrees, const Vec3& axis) {
  const Mat3 R = Eigen::AngleAxisd(degrees * std::numbers::pi / 180, axis).toRotationMatrix();
  for (Vec3& p : cloud.points) p = R * p;
  for (Vec3f& n : cloud.normals) n = (R * n.cast<double>()).cast<float>();
  return cloud;
}

inline Cloud scaled(Cloud cloud, double factor) {
  for (Vec3& p : cloud.points) p *= factor;
  return cloud;
}

inline Cloud inside_out(Cloud cloud) {
  for (Vec3f& n : cloud.normals) n = -n;
  return cloud;
}

inline Cloud without_normals(Cloud cloud) {
  cloud.normals.clear();
  return cloud;
}

inline Cloud reversed(Cloud cloud) {
  std::ranges::reverse(cloud.points);
  std::ranges::reverse(cloud.normals);
  return cloud;
}

// Returns the points p for which is_kept(p) is true.
template <typename IsKept>
Cloud where(const Cloud& cloud, IsKept is_kept) {
  Cloud kept;
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (is_kept(cloud.points[i])) add(kept, cloud.points[i], cloud.normals[i].cast<double>());
  return kept;
}

inline Cloud joined(Cloud a, const Cloud& b) {
  a.points.insert(a.points.end(), b.points.begin(), b.points.end());
  a.normals.insert(a.normals.end(), b.normals.begin(), b.normals.end());
  return a;
}

// Returns a square in front of a level sheet, tilted by 25 degrees about the y axis. Seen from the front it is 2 *
// flap_half_width wide. The relief's slopes do not contain the depth between square and sheet. So the centre of the
// square gets the height of the sheet, and the lower half of the square would be below the sheet.
inline constexpr double flap_half_width = .5;
inline Cloud flap_before_a_sheet(std::size_t points = 8000, double distance = 1) {
  const double half = flap_half_width / std::cos(25 * std::numbers::pi / 180);
  const Cloud flap = moved(turned(sheet(points, half, 0), 25, Vec3::UnitY()), Vec3(0, 0, distance));
  return joined(sheet(4 * points, 1.5, 0), flap);
}

// Returns uniformly distributed points on a cube from -1 to 1.
inline Cloud cube(std::size_t n, std::uint64_t seed = 5) {
  Random random(seed);
  Cloud cloud;
  for (std::size_t i = 0; i < n; ++i) {
    const auto axis = static_cast<int>(i % 3);
    Vec3 p(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)), normal = Vec3::Zero();
    p[axis] = normal[axis] = i % 2 ? 1 : -1;
    add(cloud, p, normal);
  }
  return cloud;
}

// Displaces every point along its normal, and tilts every normal. Both changes are Gaussian noise.
inline Cloud noisy(Cloud cloud, double sigma, double normal_sigma, std::uint64_t seed = 6) {
  Random random(seed);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    cloud.points[i] += sigma * random.gaussian() * cloud.normals[i].cast<double>();
    const Vec3 tilt(random.gaussian(), random.gaussian(), random.gaussian());
    cloud.normals[i] = (cloud.normals[i].cast<double>() + normal_sigma * tilt).normalized().cast<float>();
  }
  return cloud;
}

// Returns uniformly distributed points on a button: a flat disc of radius `radius` that faces +z, and a
// quarter of a torus with tube radius `edge` around it. The lowest points are at `z`.
inline Cloud button(std::size_t n, double radius, double edge, double z = 0, std::uint64_t seed = 12) {
  Random random(seed);
  Cloud cloud;
  const double quarter = std::numbers::pi / 2;
  const double disc_area = radius * radius / 2, edge_area = edge * (radius * quarter + edge);
  while (cloud.size() < n) {
    const double turn = random.uniform(0, 2 * std::numbers::pi);
    const Vec3 outwards(std::cos(turn), std::sin(turn), 0);
    if (random.uniform(0, disc_area + edge_area) < disc_area) {
      const double r = radius * std::sqrt(random.uniform());
      add(cloud, r * outwards + (z + edge) * Vec3::UnitZ(), Vec3::UnitZ());
      continue;
    }
    const double tilt = random.uniform(0, quarter);
    if (random.uniform(0, radius + edge) > radius + edge * std::sin(tilt)) continue;
    const Vec3 normal = std::sin(tilt) * outwards + std::cos(tilt) * Vec3::UnitZ();
    add(cloud, radius * outwards + z * Vec3::UnitZ() + edge * normal, normal);
  }
  return cloud;
}

// Returns the distance of a point from the ellipse with the half axes a along x and b along y.
inline double distance_from_ellipse(const Vec2& place, double a, double b) {
  double t = std::atan2(place.y() / b, place.x() / a);
  for (int step = 0; step < 20; ++step) {  // Newton's method for the foot of the perpendicular
    const Vec2 p(a * std::cos(t), b * std::sin(t)), tangent(-a * std::sin(t), b * std::cos(t));
    t -= (p - place).dot(tangent) / (tangent.squaredNorm() - (p - place).dot(p));
  }
  return (place - Vec2(a * std::cos(t), b * std::sin(t))).norm();
}

}  // namespace relievo::test
