// Defines the solids of the samples, and the distance functions that they consist of. Tested by
// tests/samples/sample_test.cpp.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include "relievo/core/types.h"
#include "relievo/scan/cloud.h"

namespace relievo::field {

// A solid given by a distance bound. `value` is negative inside, positive outside and zero on the surface;
// its magnitude never exceeds the distance to the surface. `box` contains the whole surface.
struct Solid {
  double (*value)(const Vec3&) = nullptr;
  Box box;
};

struct Scatter {
  std::size_t points = 0;
  double noise = 0;  // standard deviation along the normal, in sampling distances
  std::uint64_t seed = 0;
};

// Returns exactly `how.points` points, uniformly distributed over the surface's area and then moved along
// their outward normals by Gaussian noise. The normals have the errors of normals estimated from such points.
// The same arguments give the same bits. The solid must have a surface.
Cloud scatter(const Solid& solid, const Scatter& how);

inline constexpr double pi = std::numbers::pi;

// Return the samples: upright (+Y), with the front towards +Z, and about two units wide.
Solid shell();
Solid still_life();
Solid green_man();

// Returns the field of an ammonite with rim radius 1, coiled in the xy plane, with its aperture at +x. The
// slope of the field is up to 1.6, while that of an exact distance is 1.
double ammonite(const Vec3& p);

inline double square(double x) {
  return x * x;
}
inline double length(double x, double y) {
  return std::sqrt(x * x + y * y);
}
inline double clamp01(double x) {
  return std::clamp(x, 0.0, 1.0);
}

// Returns 0 below `from`, 1 above `to`, and a smooth cubic in between. If `from` is above `to`, the result
// falls from 1 to 0 instead.
inline double ramp(double from, double to, double x) {
  const double t = clamp01((x - from) / (to - from));
  return t * t * (3 - 2 * t);
}

// Returns approximately exp(-(x / width)^2), and exactly 0 beyond two widths.
inline double bump(double x, double width) {
  return square(square(std::max(0.0, 1 - square(x / width) / 4)));
}

// Return the minimum and the maximum of both values, with a fillet of about `radius`.
inline double blend_min(double a, double b, double radius) {
  const double t = std::max(radius - std::abs(a - b), 0.0);
  return std::min(a, b) - t * t / (4 * radius);
}
inline double blend_max(double a, double b, double radius) {
  return -blend_min(-a, -b, radius);
}

// Returns the distance to an ellipsoid about the origin, to first order near its surface.
inline double ellipsoid(const Vec3& p, const Vec3& radii) {
  const Vec3 q = p.cwiseQuotient(radii);
  const double k = q.norm();
  const double deepest = -radii.minCoeff();
  if (k < 1e-9) return deepest;
  return std::max(deepest, k * (k - 1) / q.cwiseQuotient(radii).norm());
}

// Returns the distance to a capsule whose radius changes from `ra` at `a` to `rb` at `b`.
inline double capsule(const Vec3& p, const Vec3& a, const Vec3& b, double ra, double rb) {
  const Vec3 ab = b - a;
  const double t = clamp01((p - a).dot(ab) / ab.squaredNorm());
  return (p - a - t * ab).norm() - (ra + t * (rb - ra));
}

// Returns the distance to a box about the origin with rounded edges.
inline double rounded_box(const Vec3& p, const Vec3& half, double radius) {
  const Vec3 q = p.cwiseAbs() - half + Vec3::Constant(radius);
  return q.cwiseMax(0).norm() + std::min(q.maxCoeff(), 0.0) - radius;
}

// Returns a point rotated about an axis by `radians`, counter-clockwise seen from the axis's positive end.
inline Vec3 turned(const Vec3& p, int axis, double radians) {
  const double c = std::cos(radians), s = std::sin(radians);
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  Vec3 q = p;
  q[u] = c * p[u] - s * p[v];
  q[v] = s * p[u] + c * p[v];
  return q;
}

// A carved leaf: a lobed blade with mid-rib and veins.
struct Leaf {
  double length = 0, half_width = 0;
  double rise = 0, curl = 0;  // the height of the mid-rib is (rise s + curl s^2) lengths at s in [0, 1]
  double lobes = 4;           // number of lobes on each side
  double thickness = 0.10;
  Vec3 root = Vec3::Zero();
  Mat3 frame = Mat3::Identity();  // the rows are the directions along, across and up
  // Computed by placed(): bounds of the leaf, used to skip distant points.
  double lowest = 0, highest = 0;  // heights along `up`, from the root
  Vec3 middle = Vec3::Zero();
  double reach = 0;  // radius of a ball around `middle` that contains the leaf
};

struct LeafPose {
  Vec3 root;
  Vec3 towards;  // direction from the root to the tip, of any length
  Vec3 facing;   // approximate normal of the upper side; not parallel to `towards`
};

Leaf placed(Leaf shape, const LeafPose& pose);

// Returns the smaller of the leaf's field at p and `nearest`. Takes almost no time far from the leaf.
double leaf_value(const Leaf& leaf, const Vec3& p, double nearest);

}  // namespace relievo::field
