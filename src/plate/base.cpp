#include "relievo/plate/base.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plate/base_image.h"
#include "plate/shape_text.h"
#include "relievo/core/text.h"

namespace relievo {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double steepest = 5.671;  // 80 degrees
constexpr double least_mm = 1e-3, most_mm = 1e6;
constexpr double default_angle_deg = 15;

constexpr const char* option = "--base";

// Checks the numbers that were given.
Result<void> check_numbers(const BaseOptions& options) {
  for (const auto& [name, mm] : {std::pair{"height", options.height_mm},
                                 {"diameter", options.diameter_mm},
                                 {"length", options.length_mm}})
    if (mm && !(*mm >= least_mm && *mm <= most_mm))
      return wrong_shape(option,
                         cat("expected a ", name, " of ", least_mm, " to ", most_mm, " mm, found ", *mm));
  if (options.angle_deg && !(*options.angle_deg > 0 && *options.angle_deg <= 80))
    return wrong_shape(option, cat("expected an angle of 0 to 80 degrees, found ", *options.angle_deg));
  if (!std::isfinite(options.direction_deg))
    return wrong_shape(option, cat("expected a direction in degrees, found ", options.direction_deg));
  if (options.height_mm && (options.angle_deg || options.diameter_mm))
    return wrong_shape(option, cat("expected either a height or ",
                                   options.angle_deg ? "an angle" : "a diameter", ", found both"));
  return {};
}

Box box_of(std::span<const Vec2> outline) {
  Box box;
  for (const Vec2& p : outline) box.extend({p.x(), p.y(), 0});
  return box;
}

// Unit vector across straight lines of that direction; exact for upright and level ones.
Vec2 across(double direction_deg) {
  const double turn = std::remainder(direction_deg - 90, 360);
  if (turn == 0) return Vec2::UnitX();
  if (turn == 90) return Vec2::UnitY();
  return {std::cos(turn * pi / 180), std::sin(turn * pi / 180)};
}

}  // namespace

Result<Base> Base::over(const BaseOptions& options, std::span<const Vec2> outline) {
  if (auto good = check_numbers(options); !good) return std::unexpected(good.error());
  const Box box = box_of(outline);
  Base base;
  if (options.kind == BaseKind::plane || box.is_empty()) return base;
  base.kind_ = options.kind;
  base.middle_ = box.centre().head<2>();
  base.across_ = across(options.direction_deg);
  base.sign_ = options.is_hollow ? -1 : 1;
  base.mirror_ = options.is_mirrored ? -1 : 1;
  double reach = 0;  // of the plate, from the middle
  for (const Vec2& p : outline) {
    const Vec2 from_middle = base.from_middle(p);
    reach = std::max(
        reach, options.kind == BaseKind::dome ? from_middle.norm() : std::abs(base.across_.dot(from_middle)));
  }
  Result<void> good;
  switch (options.kind) {
    case BaseKind::plane:
      break;
    case BaseKind::fold:
      good = base.shape_fold(options, reach);
      break;
    case BaseKind::wave:
      good = base.shape_wave(options, reach);
      break;
    case BaseKind::cylinder:
    case BaseKind::dome:
      good = base.shape_round(options, reach);
      break;
    case BaseKind::image:
      good = base.lay_image(options, box.size().head<2>());
      break;
  }
  if (!good) return std::unexpected(good.error());
  return base;
}

Result<void> Base::shape_fold(const BaseOptions& options, double reach) {
  size_ = options.height_mm ? *options.height_mm / reach
                            : std::tan(options.angle_deg.value_or(default_angle_deg) * pi / 180);
  if (size_ > 1.001 * steepest)
    return wrong_shape(option, cat("expected a height of at most ", steepest * reach,
                                   " mm on this plate, 80 degrees, found ", *options.height_mm));
  return {};
}

Result<void> Base::shape_wave(const BaseOptions& options, double reach) {
  const double length = options.length_mm   ? *options.length_mm
                        : options.height_mm ? std::max(reach, 4 * *options.height_mm)
                                            : reach;
  size_ = options.height_mm.value_or(length / 8) / 2;
  wave_number_ = 2 * pi / length;
  feature_mm_ = length / 4;
  if (size_ * wave_number_ > steepest)
    return wrong_shape(option, cat("expected a length of at least ", 2 * pi * size_ / steepest,
                                   " mm at a height of ", 2 * size_, " mm, 80 degrees, found ", length));
  return {};
}

Result<void> Base::shape_round(const BaseOptions& options, double reach) {
  const bool is_dome = kind_ == BaseKind::dome;
  const double height = options.height_mm.value_or(.15 * reach),
               of_height = (reach * reach / height + height) / 2;
  if (options.diameter_mm)
    size_ = *options.diameter_mm / 2;
  else
    size_ = is_dome || options.height_mm ? of_height : 2 * reach;
  const double smallest = reach * std::sqrt(1 + 1 / (steepest * steepest));
  if (options.diameter_mm && size_ < smallest)
    return wrong_shape(option, cat("expected a diameter of at least ", 2 * smallest,
                                   " mm on this plate, found ", *options.diameter_mm));
  const double highest = smallest - std::sqrt(smallest * smallest - reach * reach);
  if (options.height_mm && height > highest)
    return wrong_shape(option,
                       cat("expected a height of at most ", highest, " mm on this plate, found ", height));
  return {};
}

Result<void> Base::lay_image(const BaseOptions& options, const Vec2& size) {
  const auto wrong = [](const char* found) {
    return wrong_shape(option, cat("expected a height image of at least 2 x 2 finite values, found ", found));
  };
  if (!options.image) return wrong("none");
  const HeightGrid& grid = *options.image;
  if (grid.width < 2 || grid.height < 2 ||
      grid.values.size() != static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height))
    return wrong("a smaller one");
  if (!std::ranges::all_of(grid.values, [](float z) { return std::isfinite(z); }))
    return wrong("others: fill its holes");
  image_ = std::make_shared<const Image>(options.image, size,
                                         options.height_mm.value_or(.1 * std::max(size.x(), size.y())));
  feature_mm_ = image_->pixel_mm();
  return {};
}

Vec2 Base::from_middle(const Vec2& place) const {
  const Vec2 p = place - middle_;
  return {mirror_ * p.x(), p.y()};
}

double Base::profile(const Vec2& p) const {
  const double t = across_.dot(p);
  // Below 0 only beyond the plate.
  const auto cap = [&](double square) { return std::sqrt(std::max(0.0, size_ * size_ - square)) - size_; };
  switch (kind_) {
    case BaseKind::plane:
      return 0;
    case BaseKind::fold:
      return -size_ * std::abs(t);
    case BaseKind::wave:
      return size_ * (std::cos(wave_number_ * t) - 1);
    case BaseKind::cylinder:
      return cap(t * t);
    case BaseKind::dome:
      return cap(p.squaredNorm());
    case BaseKind::image:
      return image_->height(p);
  }
  return 0;
}

Vec2 Base::profile_slope(const Vec2& p) const {
  const double t = across_.dot(p);
  const auto cap = [&](double square) { return -1 / std::sqrt(std::max(1e-12, size_ * size_ - square)); };
  switch (kind_) {
    case BaseKind::plane:
      return Vec2::Zero();
    case BaseKind::fold:
      return (t > 0 ? -size_ : t < 0 ? size_ : 0) * across_;
    case BaseKind::wave:
      return -size_ * wave_number_ * std::sin(wave_number_ * t) * across_;
    case BaseKind::cylinder:
      return cap(t * t) * t * across_;
    case BaseKind::dome:
      return cap(p.squaredNorm()) * p;
    case BaseKind::image:
      return image_->slope(p);
  }
  return Vec2::Zero();
}

double Base::height(const Vec2& place) const {
  return sign_ * profile(from_middle(place));
}

Vec2 Base::slope(const Vec2& place) const {
  const Vec2 slope = sign_ * profile_slope(from_middle(place));
  return {mirror_ * slope.x(), slope.y()};
}

std::optional<double> Base::ridge_between(const Vec2& a, const Vec2& b) const {
  if (kind_ != BaseKind::fold) return std::nullopt;
  const double s = across_.dot(from_middle(a)), t = across_.dot(from_middle(b));
  const bool is_crossed = (s < 0 && t > 0) || (s > 0 && t < 0);
  if (!is_crossed) return std::nullopt;
  return s / (s - t);
}

}  // namespace relievo
