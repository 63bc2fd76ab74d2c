#include "samples/sample_shapes.h"

namespace relievo::field {
namespace {

// Raup's model: a tube whose cross-section grows by a constant factor with each turn. Lengths are in rim
// radii.
constexpr double expansion = 1.92;  // growth of the radius per turn
constexpr double section_centre = 0.735, section_half_width = 0.265, section_half_depth = 0.215;
constexpr double ribs_per_turn = 30;

struct Whorl {
  double angle;  // along the coil: 0 at the aperture, negative further inside
  double scale;  // rim radius of the shell at this angle
  // Around the cross-section: 0 at the rim, 0.5 on the flank, 1 at the seam with the inner whorl.
  double side;
};

// Returns the phase of the ribs. From the seam outwards, the ribs bend forward on the flank, then back, and
// forward again at the rim. The edge of the aperture has the same shape.
double rib_phase(const Whorl& w) {
  const double sickle = 1.5 * std::sin(2 * pi * w.side) - 5.0 * square(square(1 - w.side));
  return ribs_per_turn * w.angle + sickle;
}

// The cosine and sine of a phase. The cosine and sine of sums and multiples of phases are computed from them
// without trigonometric functions.
struct Wave {
  double c, s;
  Wave doubled() const { return {c * c - s * s, 2 * c * s}; }
  Wave plus(const Wave& o) const { return {c * o.c - s * o.s, s * o.c + c * o.s}; }
};

struct Ornament {
  double height;
  double slope;  // derivative of the height with respect to the phase in radians
};

// Returns the relief on the shell: ribs that fork between the inner and the outer flank, a knob at each fork,
// a roped keel, and striae between the ribs.
Ornament ornament(const Whorl& w, double phase) {
  const Wave rib{std::cos(phase), std::sin(phase)};
  const Wave two = rib.doubled(), four = two.doubled(), nine = four.doubled().plus(rib);
  const double crest = 0.5 + 0.5 * rib.c, crest_slope = -0.5 * rib.s;
  const double inner = 0.036 * ramp(0.40, 0.60, w.side) * ramp(1.0, 0.80, w.side) * std::sqrt(crest);
  const double outer = 0.026 * ramp(0.58, 0.38, w.side) * ramp(0.03, 0.12, w.side);
  const double knob = 0.040 * bump(w.side - 0.54, 0.055) * crest * crest * crest;
  const double keel = 0.040 * bump(w.side, 0.055);
  const double striae = 0.0011 * ramp(0.04, 0.25, w.scale);
  return {
      (inner + knob) * crest + outer * (0.5 - 0.5 * two.c) + keel * (0.8 + 0.2 * four.c) + striae * nine.c,
      (1.5 * inner + 4 * knob) * crest_slope + outer * two.s - 0.8 * keel * four.s - 9 * striae * nine.s};
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
  const Ornament raised = ornament(w, phase);
  const double slope = raised.slope * ribs_per_turn * w.scale / radius;
  const double carved = (smooth - raised.height - lip) / std::sqrt(1.2 + square(slope));
  return std::max(w.scale * blend_max(carved, -hollow, 0.02), 0.8 * phase / ribs_per_turn * radius);
}

}  // namespace

double ammonite(const Vec3& p) {
  const double growth = std::log(expansion) / (2 * pi);
  const int innermost = -6;
  const double radius = length(p.x(), p.y());
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
  const auto value = [](const Vec3& p) { return 0.75 * ammonite(turned(turned(p, 0, -0.30), 2, -0.35)); };
  return {value, {Vec3(-0.75, -0.84, -0.42), Vec3(1.04, 0.62, 0.40)}};
}

}  // namespace relievo::field
