#include <vector>

#include "samples/sample_shapes.h"

namespace relievo::field {
namespace {

// The face is symmetric, so its functions are called with x >= 0.

double skull(const Vec3& p) {
  double d = ellipsoid(p - Vec3(0, 0.06, 0), Vec3(0.47, 0.60, 0.44));
  d = blend_min(d, ellipsoid(p - Vec3(0, -0.33, 0.06), Vec3(0.34, 0.36, 0.36)), 0.16);
  d = blend_min(d, ellipsoid(p - Vec3(0.235, -0.10, 0.315), Vec3(0.13, 0.115, 0.13)), 0.12);   // cheekbone
  d = blend_min(d, ellipsoid(p - Vec3(0, -0.345, 0.36), Vec3(0.19, 0.14, 0.125)), 0.10);       // muzzle
  return blend_min(d, ellipsoid(p - Vec3(0, -0.575, 0.345), Vec3(0.115, 0.095, 0.10)), 0.09);  // chin
}

double brow(const Vec3& p) {
  const double inner = capsule(p, Vec3(0.05, 0.165, 0.430), Vec3(0.20, 0.210, 0.385), 0.050, 0.050);
  const double outer = capsule(p, Vec3(0.20, 0.210, 0.385), Vec3(0.36, 0.12, 0.23), 0.050, 0.045);
  return blend_min(inner, outer, 0.05);
}

double nose(const Vec3& p) {
  double d = capsule(p, Vec3(0, 0.16, 0.455), Vec3(0, -0.10, 0.565), 0.046, 0.056);
  d = blend_min(d, ellipsoid(p - Vec3(0, -0.135, 0.575), Vec3(0.068, 0.060, 0.070)), 0.04);
  d = blend_min(d, ellipsoid(p - Vec3(0.074, -0.152, 0.505), Vec3(0.048, 0.046, 0.062)), 0.05);
  const double nostril = ellipsoid(p - Vec3(0.046, -0.200, 0.540), Vec3(0.026, 0.026, 0.040));
  return blend_max(d, -nostril, 0.018);
}

double mouth(const Vec3& p) {
  const double upper =
      std::min(capsule(p, Vec3(0.028, -0.300, 0.497), Vec3(0.155, -0.345, 0.425), 0.030, 0.012),
               capsule(p, Vec3(0, -0.312, 0.495), Vec3(0.028, -0.300, 0.497), 0.028, 0.030));
  const double lower = capsule(p, Vec3(0, -0.382, 0.485), Vec3(0.140, -0.352, 0.425), 0.038, 0.010);
  return std::min(upper, lower);
}

double mouth_line(const Vec3& p) {
  return capsule(p, Vec3(0, -0.340, 0.52), Vec3(0.165, -0.348, 0.44), 0.010, 0.006);
}

double eye(const Vec3& p) {
  const Vec3 q = p - Vec3(0.178, 0.065, 0.325);
  const double ball = q.norm() - 0.092;
  const double iris = std::abs(length(q.x() + 0.008, q.y() - 0.004) - 0.038) - 0.005;
  const double pupil = (q - Vec3(-0.008, 0.006, 0.098)).norm() - 0.019;
  double d = q.z() > 0 ? blend_max(ball, -std::max(iris, -ball - 0.006), 0.006) : ball;
  d = blend_max(d, -pupil, 0.008);
  const double across = q.x() / 0.104;
  const double half_open = 0.036 * (1 - square(across));
  const double opening = std::abs(q.y() + 0.008 + 0.10 * q.x()) - half_open;
  const double lid = blend_max(ellipsoid(q, Vec3(0.116, 0.108, 0.108)), -opening, 0.010);
  return std::min(d, lid);
}

struct Ball {
  Vec3 centre;
  double radius;
  // The ball contains a part of the model. Returns whether that part can change the distance field at p,
  // where the field is `d` so far. Parts are joined smoothly within a distance of `fillet`.
  bool matters(const Vec3& p, double d, double fillet) const {
    return (p - centre).norm() - radius < std::abs(d) + fillet;
  }
};

double face(const Vec3& p) {
  static const Ball nose_ball{{0.03, -0.02, 0.52}, 0.27}, mouth_ball{{0.07, -0.34, 0.46}, 0.16},
      eye_ball{{0.178, 0.065, 0.325}, 0.12};
  double d = blend_min(skull(p), brow(p), 0.10);
  const double socket = ellipsoid(p - Vec3(0.178, 0.075, 0.47), Vec3(0.125, 0.085, 0.115));
  d = blend_max(d, -socket, 0.07);
  if (nose_ball.matters(p, d, 0.075)) d = blend_min(d, nose(p), 0.075);
  if (mouth_ball.matters(p, d, 0.018)) d = blend_max(blend_min(d, mouth(p), 0.018), -mouth_line(p), 0.012);
  if (eye_ball.matters(p, d, 0.012)) d = blend_min(d, eye(p), 0.012);
  return d;
}

// A wreath of leaves around the face. The leaves start on the ellipse of the face, scaled by `radius`. In
// grow(), `step` is 0 at the crown of the head and 1 at the chin.
struct Wreath {
  int leaves = 0;
  bool is_staggered = false;
  double radius = 0, z = 0, forward = 0;
  Leaf shape;
};

void grow(const Wreath& wreath, std::vector<Leaf>& leaves) {
  for (int i = 0; i <= wreath.leaves; ++i) {
    const double step = (i + (wreath.is_staggered ? 0.5 : 0.0)) / wreath.leaves;
    if (step > 1) break;
    const double a = pi * step;
    const Vec3 out(std::sin(a), std::cos(a), 0);
    const Vec3 root(wreath.radius * 0.50 * out.x(), wreath.radius * 0.64 * out.y(), wreath.z);
    const double sway = std::fmod(0.618 * (i + 1), 1.0) - 0.5;  // different for each leaf
    const bool is_central = out.x() < 0.01;
    const double turn = is_central ? 0 : 0.30 * sway;
    const Vec3 towards(out.x() + turn * out.y(), 0.9 * out.y() - turn * out.x(), wreath.forward);
    const Vec3 facing(out.x() * 0.5 - turn * out.y(), out.y() * 0.5 + turn * out.x(), 1);
    Leaf shape = wreath.shape;
    shape.length *= 1 + 0.12 * sway;
    shape.curl += 0.1 * sway;
    leaves.push_back(placed(shape, {root, towards, facing}));
  }
}

std::vector<Leaf> grow_leaves() {
  std::vector<Leaf> leaves;
  const auto shape = [](double length, double half_width, double rise, double curl, double lobes) {
    Leaf leaf;
    leaf.length = length, leaf.half_width = half_width, leaf.rise = rise, leaf.curl = curl,
    leaf.lobes = lobes;
    return leaf;
  };
  grow({8, false, 0.86, -0.02, 0.0, shape(0.56, 0.165, 0.25, -0.28, 5)}, leaves);
  grow({8, true, 0.80, 0.12, 0.05, shape(0.42, 0.145, 0.35, -0.45, 4)}, leaves);
  // These leaves are the brows, the moustache and the beard.
  leaves.push_back(
      placed(shape(0.40, 0.105, 0.25, -0.6, 4), {{0.06, 0.19, 0.45}, {1, 0.50, -0.25}, {0.2, 0.25, 1}}));
  leaves.push_back(
      placed(shape(0.44, 0.095, 0.15, -0.55, 4), {{0.035, -0.245, 0.49}, {1, -0.42, -0.10}, {0.2, 0.1, 1}}));
  leaves.push_back(
      placed(shape(0.46, 0.12, 0.25, -0.45, 4), {{0.06, -0.44, 0.40}, {0.62, -1, 0.0}, {0.3, 0, 1}}));
  leaves.push_back(
      placed(shape(0.52, 0.125, 0.15, -0.30, 4), {{0.0, -0.44, 0.42}, {0, -1, 0.18}, {0, 0.2, 1}}));
  leaves.push_back(placed(shape(0.46, 0.13, 0.35, -0.5, 4), {{0.0, 0.34, 0.40}, {0, 1, -0.1}, {0, 0.2, 1}}));
  leaves.push_back(
      placed(shape(0.42, 0.125, 0.35, -0.5, 4), {{0.16, 0.33, 0.37}, {0.55, 1, -0.15}, {0.2, 0.2, 1}}));
  return leaves;
}

double value(const Vec3& point) {
  static const std::vector<Leaf> leaves = grow_leaves();
  const Vec3 p(std::abs(point.x()), point.y(), point.z());
  double d = ellipsoid(p - Vec3(0, 0, -0.10), Vec3(0.72, 0.84, 0.16));
  for (const Leaf& leaf : leaves) d = leaf_value(leaf, p, d);
  if (ellipsoid(p, Vec3(0.58, 0.78, 0.74)) < d) {
    // Prevents a crease where the two halves meet.
    const double softened = std::sqrt(square(p.x()) + square(0.012));
    d = std::min(d, face(Vec3(softened, p.y(), p.z())));
  }
  return 0.85 * blend_max(d, -0.14 - p.z(), 0.03);
}

}  // namespace

Solid green_man() {
  return {value, {Vec3(-1.02, -1.14, -0.17), Vec3(1.02, 1.14, 0.68)}};
}

}  // namespace relievo::field
