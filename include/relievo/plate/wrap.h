// Bodies that a finished plate is bent around, thickness and all.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "relievo/core/error.h"
#include "relievo/core/types.h"

namespace relievo {

enum class WrapKind { none, cylinder, cone, sphere };

// Lengths on the ground are true across a cylinder, at half the height of a cone, and away from the middle on
// a sphere; the relief stands upright on it everywhere.
struct WrapOptions {
  WrapKind kind = WrapKind::none;
  std::optional<double> diameter_mm;  // of the ground; of a cone in the middle of the plate
  std::optional<double> turn_deg;  // that the plate goes around it, instead of the diameter; 180, sphere 120
  double angle_deg = 10;      // of a cone: between its side and its axis; it is narrow above, if positive
  double direction_deg = 90;  // of the axis, counter-clockwise from the x axis: upright
  bool is_inside = false;     // the relief is on the inner side
};

// Returns the wrap of a text like "cylinder:diameter=60", "cylinder:turn=360" or "cone:diameter=70,angle=8".
// Errors: kind option for any other text.
Result<WrapOptions> parse_wrap(std::string_view text);

// A wrap of one plate.
class Wrap {
 public:
  // Returns the wrap of a plate of that outline, the middle of whose box comes to lie in front. Errors: kind
  // option for a number out of its range, a diameter and a turn, a plate that goes around more than once (a
  // sphere: more than 340 degrees), or a cone whose tip it would reach.
  static Result<Wrap> around(const WrapOptions& options, std::span<const Vec2> outline);

  // Where a place of the flat plate goes, so far above the ground: the axis, or the sphere's centre, runs
  // through the origin, and the viewer is in +Z as before. The way round is kept.
  Vec3 at(const Vec2& place, double above_ground_mm) const;

  // How far from the ground the axis is where it is nearest: neither the relief nor the back may reach that.
  double reach_mm() const { return least_radius_; }

  // Minus how far the ground falls away from the plane in front, about: for choosing triangles.
  double sag(const Vec2& place) const;

  double diameter_mm() const { return 2 * radius_; }
  double turn_deg() const { return turn_deg_; }
  double mm_per_degree() const;

  // Do the plate's sides meet?
  bool is_closed() const { return kind_ != WrapKind::sphere && turn_deg_ == 360; }
  bool is_inside() const { return is_inside_; }
  Vec2 across() const { return across_; }

 private:
  WrapKind kind_ = WrapKind::none;
  bool is_inside_ = false;
  Vec2 middle_ = Vec2::Zero(), across_ = Vec2::UnitX();
  double radius_ = 1, turn_deg_ = 0, radians_per_mm_ = 1, least_radius_ = 1;
  double sine_ = 0, cosine_ = 1;  // of a cone's angle
};

}  // namespace relievo
