// Describes bodies around which a finished plate is bent, and computes the bent positions.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

#include "relievo/core/choice.h"
#include "relievo/core/error.h"
#include "relievo/core/types.h"

namespace relievo {

enum class WrapKind { none, cylinder, cone, sphere };

inline constexpr std::array<Choice<WrapKind>, 4> wrap_choices{{{"none", WrapKind::none},
                                                               {"cylinder", WrapKind::cylinder},
                                                               {"cone", WrapKind::cone},
                                                               {"sphere", WrapKind::sphere}}};

// Bending preserves lengths on the ground: around a cylinder, around a cone at half its height, and from the
// middle outwards on a sphere. Heights of the relief are perpendicular to the wrap.
struct WrapOptions {
  WrapKind kind = WrapKind::none;
  std::optional<double> diameter_mm;  // diameter of the bent ground; for a cone, in the middle of the plate
  std::optional<double>
      turn_deg;           // angle that the plate covers, instead of a diameter; default: 180, sphere: 120
  double angle_deg = 10;  // cone: angle between its side and its axis; positive if it is narrow at the top
  double direction_deg = 90;  // direction of the axis, counter-clockwise from x; 90 is vertical
  bool is_inside = false;     // whether the relief is on the inner side

  bool operator==(const WrapOptions&) const = default;
};

// Returns the wrap described by a text such as "cylinder:diameter=60", "cylinder:turn=360" or
// "cone:diameter=70,angle=8". Errors: kind option for any other text.
Result<WrapOptions> parse_wrap(std::string_view text);

// The body around which a plate is bent.
class Wrap {
 public:
  // Returns the wrap of a plate with that outline; the centre of the outline's bounding box faces the viewer.
  // Errors: kind option for a number out of range, for a diameter together with a turn, for a plate that goes
  // around more than once (a sphere: more than 340 degrees), and for a cone whose tip is on the plate.
  static Result<Wrap> around(const WrapOptions& options, std::span<const Vec2> outline);

  // Returns the bent position of the point at this height above `place` on the flat plate. The axis or the
  // sphere's centre passes through the origin; the viewer is at +Z. Orientation is preserved.
  Vec3 at(const Vec2& place, double above_ground_mm) const;

  // Returns the smallest distance of the ground from the axis, in mm. The relief and the back of the plate
  // must be less deep than that.
  double min_radius_mm() const { return min_radius_; }

  // Returns the approximate z in mm of the bent ground at this place, relative to the plane that is tangent to the
  // ground in the plate's middle. It is quadratic in the place. Inside a body it is positive, otherwise negative.
  double sag(const Vec2& place) const;

  double diameter_mm() const { return 2 * radius_; }
  double turn_deg() const { return turn_deg_; }
  double mm_per_degree() const;  // length of one degree around the axis, on the ground

  // Returns whether the plate goes all the way around, so that its sides meet.
  bool is_closed() const { return kind_ != WrapKind::sphere && turn_deg_ == 360; }
  bool is_inside() const { return is_inside_; }
  Vec2 across() const { return across_; }

 private:
  WrapKind kind_ = WrapKind::none;
  bool is_inside_ = false;
  Vec2 middle_ = Vec2::Zero(), across_ = Vec2::UnitX();
  double radius_ = 1, turn_deg_ = 0, radians_per_mm_ = 1, min_radius_ = 1;
  double sine_ = 0, cosine_ = 1;  // sine and cosine of a cone's angle
};

}  // namespace relievo
