#include <array>
#include <functional>

#include "samples/sample_shapes.h"

namespace relievo::field {
namespace {

// Distances in the half-plane of a surface of revolution, at a given radius and height.
struct Turned {
  double r, y;
  double ellipse(double centre, double radius, double half_height) const {
    return ellipsoid(Vec3(r, y - centre, 0), Vec3(radius, half_height, 1));
  }
  double disc(double centre, double radius, double half_height, double round) const {
    const double u = r - radius + round, v = std::abs(y - centre) - half_height + round;
    return length(std::max(u, 0.0), std::max(v, 0.0)) + std::min(std::max(u, v), 0.0) - round;
  }
  double ring(double centre, double radius, double thickness) const {
    return length(r - radius, y - centre) - thickness;
  }
};

// Returns the height of two strands that cross each other around the belly, with a pearl in each gap.
double guilloche(double about, double y) {
  const double wave = 0.036 * std::sin(12 * about);
  const double strands = std::max(bump(y - wave, 0.016), bump(y + wave, 0.016));
  const double eye = std::abs(std::sin(12 * about));
  return 0.013 * strands + 0.016 * bump(1 - eye, 0.14) * bump(y, 0.017);
}

double belly_ornament(double about, double y) {
  const double gadroon = std::abs(std::cos(11 * about));
  const double tongue = std::abs(std::cos(14 * about));
  const double lower = ramp(-0.02, -0.07, y) * ramp(-0.36, -0.30, y);
  const double upper = ramp(0.17, 0.19, y) * ramp(0.335, 0.27, y - 0.02 * tongue);
  const double fillets = bump(y - 0.005, 0.011) + bump(y - 0.145, 0.011);
  return 0.028 * lower * gadroon * (2 - gadroon) + 0.018 * upper * tongue + 0.012 * fillets +
         guilloche(about, y - 0.075);
}

double urn(const Vec3& p) {
  const double about = std::atan2(p.x(), p.z());
  const Turned q{length(p.x(), p.z()), p.y()};
  const double body = q.ellipse(0.04, 0.40, 0.385) - belly_ornament(about, q.y);
  const double flare =
      0.135 + 0.55 * square(std::max(0.0, q.y - 0.42)) + 0.25 * square(std::max(0.0, 0.42 - q.y));
  const double flute = 0.011 * std::abs(std::sin(12 * about)) * ramp(0.42, 0.46, q.y) * ramp(0.70, 0.64, q.y);
  const double neck = std::max(0.8 * (q.r - flare - flute), std::abs(q.y - 0.54) - 0.22);
  const double stem = std::max(0.8 * (q.r - 0.085 - 1.1 * square(q.y + 0.40)), std::abs(q.y + 0.44) - 0.14);
  double d = blend_min(body, neck, 0.03);
  d = blend_min(d, stem, 0.04);
  const double egg = 0.010 * std::abs(std::cos(18 * about));
  d = std::min(d, q.disc(0.765, 0.245 + egg, 0.030, 0.028));
  d = std::min(
      {d, q.disc(-0.57, 0.235, 0.030, 0.02), q.ring(-0.525, 0.185, 0.026), q.ring(-0.355, 0.115, 0.024)});
  d = std::min({d, q.ring(0.405, 0.165, 0.022), q.ring(0.715, 0.195, 0.016)});
  const double bore = std::max(q.r - flare + 0.035, 0.62 - q.y);
  return blend_max(d, -0.8 * bore, 0.02);
}

double handle(const Vec3& p) {
  const Vec3 q(std::abs(p.x()) - 0.285, p.y() - 0.455, p.z());
  const double ring = length(q.x(), q.y());
  const double about = std::atan2(q.y(), q.x());
  const double cord = 0.006 * std::cos(3 * std::atan2(q.z(), ring - 0.155) + 26 * about);
  return length(ring - 0.155, q.z()) - 0.030 - cord;
}

// Returns the field of a ring of three-stranded rope in the XY plane.
double rope_ring(const Vec3& p) {
  const double ring = length(p.x(), p.y());
  const double about = std::atan2(p.y(), p.x());
  const double u = ring - 0.26, v = p.z();
  const double twist = std::atan2(v, u) + 9 * about;
  const double strand = 2 * pi / 3;
  const double folded = twist - strand * std::round(twist / strand);
  const double r = length(u, v);
  const double cu = r * std::cos(folded) - 0.034, cv = r * std::sin(folded);
  const double yarn = 0.0022 * ramp(-0.014, 0.006, cu) * std::cos(6 * std::atan2(cv, cu) - 60 * about);
  return length(cu, cv) - 0.036 - yarn;
}

struct Height {
  double value = 0, slope = 0;
};

// Returns the height of overlapping scales, one at each pair of integers. Each scale rises towards its free,
// upper edge.
Height scales(double a, double b) {
  Height highest;
  for (int i = -1; i <= 1; ++i) {
    for (int j = -1; j <= 1; ++j) {
      const double da = a - std::round(a) - i, db = b - std::round(b) - j;
      const double up = (da - db) / 2, across = (da + db) / 2;
      const double out = std::sqrt(square(up) + 1.1 * square(across));
      const double to_rim = clamp01((0.64 - out) / 0.14);
      if (to_rim == 0) continue;
      const double top = 0.45 + 0.7 * up + 0.12 * bump(across, 0.16) * ramp(-0.4, 0.4, up);
      const double height = top * to_rim * to_rim * (3 - 2 * to_rim);
      if (height > highest.value) highest = {height, top * 6 * to_rim * (1 - to_rim) / 0.14};
    }
  }
  return highest;
}

// Returns the field of a pine cone along Y. Its scales form two families of spirals, 5 in one direction and 8
// in the other.
double pine_cone(const Vec3& p) {
  const double half = 0.32, scale_size = 0.09;
  const double about = std::atan2(p.x(), p.z()) / (2 * pi);
  const double h = std::clamp(p.y() / half, -1.0, 1.0);
  const double taper = 0.165 * (1 - 0.25 * h);
  const double body = ellipsoid(p, Vec3(taper, half, taper));
  const double rise = 3.6 * h + 0.6 * h * h * h;
  const double depth = 0.052 * ramp(1.0, 0.7, std::abs(h));
  const Height carved = scales(5 * about + rise, 8 * about - 1.1 * rise);
  return (body - depth * carved.value) / std::sqrt(1.6 + square(depth / scale_size * carved.slope));
}

// Returns the field of a dodecahedron with a line engraved along its edges.
double gem(const Vec3& p) {
  const double g = (1 + std::sqrt(5.0)) / 2, n = 1 / std::sqrt(1 + g * g);
  const Vec3 q = p.cwiseAbs();
  std::array<double, 6> faces{q.x() + g * q.y(),  q.y() + g * q.z(),  q.z() + g * q.x(),
                              -q.x() + g * q.y(), -q.y() + g * q.z(), -q.z() + g * q.x()};
  std::partial_sort(faces.begin(), faces.begin() + 2, faces.end(), std::greater<>());
  const double to_edge = n * (faces[0] - faces[1]);
  return n * faces[0] - 0.155 + 0.008 * bump(to_edge - 0.030, 0.007);
}

double plinth(const Vec3& p) {
  const double slab = rounded_box(p, Vec3(1.03, 0.028, 0.43), 0.018);
  const double die = rounded_box(p - Vec3(0, -0.105, 0), Vec3(0.97, 0.09, 0.37), 0.01);
  const double foot = rounded_box(p - Vec3(0, -0.215, 0), Vec3(1.05, 0.035, 0.45), 0.02);
  const double pitch = 0.0808, half_row = 11.5;  // 24 pearls
  const double nearest = std::clamp(std::round(p.x() / pitch - 0.5), -half_row - 0.5, half_row - 0.5) + 0.5;
  const double pearls = ellipsoid(p - Vec3(nearest * pitch, -0.105, 0.37), Vec3(0.036, 0.052, 0.036));
  return std::min({slab, die, foot, pearls});
}

std::array<Leaf, 3> bouquet() {
  const auto shape = [](double length, double half_width, double rise, double curl) {
    Leaf leaf;
    leaf.length = length, leaf.half_width = half_width, leaf.rise = rise, leaf.curl = curl;
    leaf.thickness = 0.03;
    return leaf;
  };
  return {placed(shape(0.42, 0.12, 0.35, -0.5), {{0.50, -0.52, 0.20}, {0.9, 0.75, 0}, {0, 0, 1}}),
          placed(shape(0.40, 0.11, 0.35, -0.5), {{0.55, -0.55, 0.24}, {1, 0.12, 0.1}, {0, 0.3, 1}}),
          placed(shape(0.40, 0.11, 0.35, -0.5), {{0.40, -0.50, 0.20}, {0.15, 1, 0.1}, {0, 0, 1}})};
}

double still_life_value(const Vec3& p) {
  static const std::array<Leaf, 3> leaves = bouquet();
  double d = plinth(p - Vec3(0, -0.72, 0));
  const auto add = [&](const Vec3& centre, double reach, auto&& solid) {
    const Vec3 q = p - centre;
    if (q.norm() - reach < d) d = std::min(d, solid(q));
  };
  add({-0.08, -0.09, -0.10}, 0.95, [](const Vec3& q) { return 0.5 * std::min(urn(q), handle(q)); });
  add({-0.60, -0.345, 0.22}, 0.50,
      [](const Vec3& q) { return 0.42 * 0.75 * ammonite(turned(turned(q, 0, 0.20), 2, 2.1) / 0.42); });
  add({0.50, -0.36, 0.02}, 0.40,
      [](const Vec3& q) { return 0.7 * rope_ring(turned(turned(q, 0, 0.25), 1, 0.3)); });
  add({0.56, -0.49, 0.27}, 0.40,
      [](const Vec3& q) { return 0.9 * pine_cone(turned(turned(q, 2, 0.95), 0, -0.2)); });
  add({0.08, -0.545, 0.32}, 0.20,
      [](const Vec3& q) { return 0.75 * gem(turned(turned(q, 1, 0.4), 0, 0.5)); });
  for (const Leaf& leaf : leaves) d = leaf_value(leaf, p, d);
  return d;
}

}  // namespace

Solid still_life() {
  return {still_life_value, {Vec3(-1.08, -1.00, -0.55), Vec3(1.08, 0.74, 0.55)}};
}

}  // namespace relievo::field
