#include "samples/sample_shapes.h"

#include <Eigen/Geometry>

namespace relievo::field {
namespace {

constexpr double drooping = 0.22;         // depth of the rim below the mid-rib, in half widths
constexpr double highest_carving = 0.05;  // height above the blade
constexpr double gentle =
    0.68;  // scales the field to compensate for the slope of the carving, so that it stays a distance bound

// The position of a point above the blade.
struct Place {
  double along;   // 0 at the root, 1 at the tip
  double vein;    // `along` where the slanted side vein through the point leaves the mid-rib
  double lobe;    // 0 in a notch, 1 in the middle of a lobe
  double beat;    // position within the lobe, from 0 to 1
  double across;  // distance from the mid-rib, in half widths
};

Place locate(const Leaf& leaf, double x, double v) {
  const double s = clamp01(x / leaf.length);
  const double t = clamp01(s - 0.75 * v / leaf.length * (1 - s * s));
  const double beat = leaf.lobes * t - static_cast<int>(leaf.lobes * t);
  return {s, t, 4 * beat * (1 - beat), beat, v / leaf.half_width};
}

// Returns the approximate distance to the outline, an oval with notches. It is the distance across the leaf
// divided by sqrt(1 + slope^2). The slope is that of the outline, and is large in the notches.
double outline(const Leaf& leaf, const Place& at) {
  const double bent = at.vein * (1.25 - 0.25 * at.vein);
  const double oval = std::sqrt(std::max(1e-4, 4 * bent * (1 - bent)));
  const double depth = 0.46, notch = square(1 - at.lobe);
  const double width = oval * (1 - depth * notch);
  const double oval_slope = 2.5 * std::abs(1 - 2 * bent) / oval;
  const double notch_slope = 8 * depth * leaf.lobes * oval * std::abs(1 - 2 * at.beat) * (1 - at.lobe);
  const double slope = leaf.half_width / leaf.length * (oval_slope + notch_slope);
  return leaf.half_width * (at.across - width) / std::sqrt(1 + square(slope));
}

// Returns the height of the carving above the bent blade.
double carving(const Leaf& leaf, const Place& at) {
  const double v = at.across * leaf.half_width;
  const double last_lobe = ramp(leaf.lobes - 0.7, leaf.lobes - 1.2, leaf.lobes * at.vein);
  const double rib = bump(v, 0.05 * leaf.half_width + 0.006) * ramp(1.02, 0.6, at.along);
  const double vein =
      bump(at.beat - 0.5, 0.10) * ramp(1.0, 0.4, at.across) * ramp(0, 0.15, at.vein) * last_lobe;
  const double puff = at.lobe * ramp(0.0, 0.5, at.across) * ramp(1.3, 0.6, at.across);
  return 0.017 * rib + 0.009 * vein + 0.020 * puff;
}

}  // namespace

Leaf placed(Leaf shape, const LeafPose& pose) {
  const Vec3 along = pose.towards.normalized();
  const Vec3 across = pose.facing.cross(along).normalized();
  const Vec3 up = along.cross(across);
  shape.root = pose.root;
  shape.frame << along.transpose(), across.transpose(), up.transpose();
  shape.middle = pose.root + shape.length * (0.5 * along + (0.5 * shape.rise + 0.35 * shape.curl) * up);
  const double bend = std::abs(shape.rise) + std::abs(shape.curl);
  const double tip = shape.rise + shape.curl;
  const double peak =
      shape.curl < 0 && tip < shape.rise ? -square(shape.rise) / (4 * shape.curl) : std::max(tip, 0.0);
  shape.highest = shape.length * peak + highest_carving;
  shape.lowest = shape.length * std::min(tip, 0.0) - drooping * shape.half_width - shape.thickness;
  shape.reach = shape.length * 0.5 * (1 + bend) + shape.half_width + shape.thickness / 2;
  return shape;
}

double leaf_value(const Leaf& leaf, const Vec3& p, double nearest) {
  if ((p - leaf.middle).squaredNorm() > square(std::max(0.0, leaf.reach + nearest))) return nearest;
  const Vec3 q = leaf.frame * (p - leaf.root);
  const double v = std::abs(q.y());
  const double beyond = std::max({-q.x(), q.x() - leaf.length, v - leaf.half_width});
  const double off = gentle * std::max(q.z() - leaf.highest, leaf.lowest - q.z());
  if (std::max(beyond, off) > nearest) return nearest;
  const Place at = locate(leaf, q.x(), v);
  const double side = 0.7 * outline(leaf, at);
  if (side > nearest) return nearest;
  const double droop = drooping * leaf.half_width * square(at.across);
  const double blade = leaf.length * at.along * (leaf.rise + leaf.curl * at.along) - droop;
  const double above = gentle * (q.z() - blade - carving(leaf, at)),
               below = 0.6 * (blade - leaf.thickness - q.z());
  return std::min(nearest, blend_max(blend_max(std::max(above, below), side, 0.015), beyond, 0.01));
}

}  // namespace relievo::field
