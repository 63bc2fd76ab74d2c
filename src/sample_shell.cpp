#include "sample_shapes.h"

namespace relievo::field {
namespace {

// Raup's model: a tube whose cross-section grows by a constant factor each turn, measured in rim radii.
constexpr double expansion = 1.92;  // per turn
constexpr double section_centre = 0.735, section_half_width = 0.265, section_half_depth = 0.215;
constexpr double ribs_per_turn = 30;

struct Whorl {
  double angle;  // along the coil; 0 at the aperture, negative inside
  double scale;  // rim radius there
  double side;   // around the section: 0 at the rim, 0.5 on the flank, 1 at the seam with the inner whorl
};

// Ribs bend forward on the flank, back, and forward again to the rim; the aperture's edge follows them.
double rib_phase(const Whorl& w) {
  const double sickle = 1.5 * std::sin(2 * pi * w.side) - 5.0 * square(square(1 - w.side));
  return ribs_per_turn * w.angle + sickle;
}

double ornament(const Whorl& w, double phase) {
  const double crest = 0.5 + 0.5 * std::cos(phase);
  const double fork = 0.5 - 0.5 * std::cos(2 * phase);
  const double inner = ramp(0.40, 0.60, w.side) * ramp(1.0, 0.80, w.side);
  const double outer = ramp(0.58, 0.38, w.side) * ramp(0.03, 0.12, w.side);
  const double knob = bump(w.side - 0.54, 0.055) * square(square(crest));
  const double keel = bump(w.side, 0.055) * (0.8 + 0.2 * std::cos(4 * phase));
  const double striae = ramp(0.04, 0.25, w.scale) * std::cos(9 * phase);
  return 0.036 * inner * crest * std::sqrt(crest) + 0.026 * outer * fork + 0.040 * knob + 0.04 * keel +
         0.0011 * striae;
}

double section(double u, double v) {
  return ellipsoid(Vec3(u, v, 0), Vec3(section_half_width, section_half_depth, 1));
}

double whorl(double radius, double z, const Whorl& at, double nearest) {
  const double u = radius / at.scale - section_centre, v = std::abs(z) / at.scale;
  const double smooth = section(u, v), highest_ornament = 0.10;
  const double bound = at.scale * (smooth - highest_ornament);
  if (bound > std::max(nearest, 0.05 * at.scale)) return bound;
  Whorl w = at;
  w.side = std::atan2(v / section_half_depth, u / section_half_width) / pi;
  const double phase = rib_phase(w);
  const double lip = 0.03 * ramp(-0.16, -0.02, w.angle);
  const double hollow = std::max(smooth + 0.045, (-1.0 - w.angle) * 0.7);
  const double d = blend_max(smooth - ornament(w, phase) - lip, -hollow, 0.02);
  return std::max(w.scale * d, phase / ribs_per_turn * radius);
}

}  // namespace

double ammonite(const Vec3& p) {
  const double growth = std::log(expansion) / (2 * pi);
  const int innermost = -6;
  const double radius = std::hypot(p.x(), p.y());
  const double about = std::atan2(p.y(), p.x());
  const double rim_angle = std::min(0.0, std::log(std::max(radius, 1e-3)) / growth);
  const int turn = static_cast<int>(std::ceil((rim_angle - about) / (2 * pi)));
  const double fillet = 0.012 * std::min(1.0, 2 * radius);
  double d = p.norm() - 0.02;
  double scale = std::exp(growth * (about + 2 * pi * turn));
  for (const int k : {turn, turn + 1, turn - 1}) {
    const double angle = about + 2 * pi * k;
    if (angle > pi || k < innermost) continue;
    const double here = k == turn ? scale : k > turn ? scale * expansion : scale / expansion;
    d = blend_min(d, whorl(radius, p.z(), {angle, here, 0}, d + fillet), fillet);
  }
  return d;
}

Solid shell() {
  const auto value = [](const Vec3& p) { return 0.6 * ammonite(turned(turned(p, 0, -0.30), 2, -0.35)); };
  return {value, {Vec3(-1.1, -1.1, -0.7), Vec3(1.1, 1.1, 0.7)}};
}

}  // namespace relievo::field
