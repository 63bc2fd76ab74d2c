#include "relievo/plate/wrap.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/angle.h"
#include "plate/shape_text.h"
#include "relievo/core/text.h"

namespace relievo {
namespace {

constexpr double most_of_sphere_deg = 340;  // at a larger angle, the rim would meet itself behind the sphere
constexpr double closing_deg = .01;         // an angle this close to a full turn counts as a full turn

// The size of the plate across and along the wrap's axis, and the distance of its farthest point from its
// middle.
struct Extent {
  double across = 0, along = 0, radius = 0;
};

Extent extent_of(std::span<const Vec2> outline, const Vec2& middle, const Vec2& across) {
  const Vec2 along(-across.y(), across.x());
  Extent extent;
  for (const Vec2& p : outline) {
    extent.across = std::max(extent.across, 2 * std::abs(across.dot(p - middle)));
    extent.along = std::max(extent.along, 2 * std::abs(along.dot(p - middle)));
    extent.radius = std::max(extent.radius, (p - middle).norm());
  }
  return extent;
}

Result<void> check_numbers(const WrapOptions& options) {
  if (options.diameter_mm && !(*options.diameter_mm >= .01 && *options.diameter_mm <= 1e6))
    return option_error("wrap", cat("expected a diameter of 0.01 to 1e+06 mm, found ", *options.diameter_mm));
  if (options.turn_deg && !(*options.turn_deg >= .01 && *options.turn_deg <= 360))
    return option_error("wrap", cat("expected a turn of 0.01 to 360 degrees, found ", *options.turn_deg));
  if (options.diameter_mm && options.turn_deg)
    return option_error("wrap", "expected either a diameter or a turn, found both");
  if (options.kind == WrapKind::cone && !(std::abs(options.angle_deg) <= 80))
    return option_error("wrap", cat("expected an angle of -80 to 80 degrees, found ", options.angle_deg));
  if (!std::isfinite(options.direction_deg))
    return option_error("wrap", cat("expected a direction in degrees, found ", options.direction_deg));
  return {};
}

// Returns the unit vector that is perpendicular to the axis and points to its right. The result is exact for
// 90 and 0 degrees.
Vec2 across_of(double direction_deg) {
  const double turn = std::remainder(direction_deg - 90, 360);
  if (turn == 0) return Vec2::UnitX();
  if (turn == -90) return -Vec2::UnitY();
  return {std::cos(to_radians(turn)), std::sin(to_radians(turn))};
}

}  // namespace

Result<WrapOptions> parse_wrap(std::string_view text) {
  RELIEVO_TRY(const WrapKind kind, parse_choice("wrap", shape_kind(text), wrap_choices));
  WrapOptions wrap;
  wrap.kind = kind;
  std::optional<double> direction, angle;
  std::vector<ShapeNumber> numbers;
  std::vector<ShapeWord> words;
  if (wrap.kind != WrapKind::none) {
    numbers = {{"diameter", &wrap.diameter_mm}, {"turn", &wrap.turn_deg, ShapeUnit::degrees}};
    words = {{"inside", &wrap.is_inside}};
  }
  if (wrap.kind == WrapKind::cone) numbers.push_back({"angle", &angle, ShapeUnit::degrees});
  if (wrap.kind == WrapKind::cone || wrap.kind == WrapKind::cylinder)
    numbers.push_back({"direction", &direction, ShapeUnit::degrees});
  RELIEVO_CHECK(read_shape(text, "wrap", numbers, words));
  wrap.direction_deg = direction.value_or(wrap.direction_deg);
  wrap.angle_deg = angle.value_or(wrap.angle_deg);
  return wrap;
}

Result<Wrap> Wrap::around(const WrapOptions& options, std::span<const Vec2> outline) {
  RELIEVO_CHECK(check_numbers(options));
  const Box box = Box::of(outline);
  Wrap wrap;
  wrap.kind_ = options.kind;
  wrap.is_inside_ = options.is_inside;
  wrap.middle_ = box.centre().head<2>();
  const bool is_sphere = options.kind == WrapKind::sphere;
  if (!is_sphere) wrap.across_ = across_of(options.direction_deg);
  const Extent extent = extent_of(outline, wrap.middle_, wrap.across_);
  const double wide = is_sphere ? 2 * extent.radius : extent.across;
  const double turn = options.turn_deg.value_or(is_sphere ? 120 : 180);
  wrap.radius_ = options.diameter_mm ? *options.diameter_mm / 2 : wide * 180 / (std::numbers::pi * turn);
  wrap.turn_deg_ = to_degrees(wide / wrap.radius_);
  if (std::abs(wrap.turn_deg_ - 360) < closing_deg) wrap.turn_deg_ = 360;
  const double most = is_sphere ? most_of_sphere_deg : 360;
  if (wrap.turn_deg_ > most)
    return option_error("wrap",
                        cat("expected a diameter of at least ", wide * 360 / (std::numbers::pi * most),
                            " mm for this plate, found ", 2 * wrap.radius_));
  wrap.radians_per_mm_ = to_radians(wrap.turn_deg_) / wide;
  wrap.min_radius_ = wrap.radius_;
  if (options.kind == WrapKind::cone) {
    wrap.sine_ = std::sin(to_radians(options.angle_deg));
    wrap.cosine_ = std::cos(to_radians(options.angle_deg));
    wrap.min_radius_ = (wrap.radius_ - extent.along / 2 * std::abs(wrap.sine_)) / wrap.cosine_;
    if (!(wrap.min_radius_ > 0))
      return option_error("wrap", cat("expected a diameter of at least ", extent.along * std::abs(wrap.sine_),
                                      " mm for this plate on this cone, found ", 2 * wrap.radius_));
  }
  return wrap;
}

Vec3 Wrap::at(const Vec2& place, double above_ground_mm) const {
  const Vec2 p = place - middle_, along(-across_.y(), across_.x());
  const double side = is_inside_ ? -1 : 1, out = side * above_ground_mm;
  if (kind_ == WrapKind::none) return {p.x(), p.y(), above_ground_mm};
  if (kind_ == WrapKind::sphere) {
    const double way = p.norm(), angle = way / radius_;
    const Vec2 flat = way > 0 ? Vec2(std::sin(angle) / way * p) : Vec2::Zero();
    return (radius_ + out) * Vec3(flat.x(), flat.y(), side * std::cos(angle));
  }
  const double angle = across_.dot(p) * radians_per_mm_, slant = along.dot(p);
  const double radius = radius_ - slant * sine_ + out * cosine_;
  const Vec2 flat = radius * std::sin(angle) * across_ + (slant * cosine_ + out * sine_) * along;
  return {flat.x(), flat.y(), side * radius * std::cos(angle)};
}

double Wrap::sag(const Vec2& place) const {
  const Vec2 p = place - middle_;
  if (kind_ == WrapKind::none) return 0;
  const double side = is_inside_ ? 1 : -1;
  if (kind_ == WrapKind::sphere) return side * p.squaredNorm() / (2 * radius_);
  const double way = across_.dot(p);
  return side * way * way / (2 * min_radius_);
}

double Wrap::mm_per_degree() const {
  return to_radians(1) / (kind_ == WrapKind::sphere ? 1 / radius_ : radians_per_mm_);
}

}  // namespace relievo
