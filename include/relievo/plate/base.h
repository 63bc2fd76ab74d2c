// The surface that a relief lies on, as a height over the plane of its plate.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "relievo/core/error.h"
#include "relievo/core/types.h"

namespace relievo {

// Heights in any unit, row-major, first row at the top.
struct HeightGrid {
  int width = 0, height = 0;
  std::vector<float> values;
};

enum class BaseKind {
  plane,
  fold,      // two planes that meet in a ridge
  wave,      // a cosine
  cylinder,  // seen from outside, lying on the plate
  dome,      // the cap of a sphere
  image      // a height map
};

// Highest in the middle of the plate, unless it is hollow. Fold, wave and cylinder are straight along one
// direction.
struct BaseOptions {
  BaseKind kind = BaseKind::plane;
  std::optional<double> height_mm;    // lowest to highest; of an image over all of it, else over the plate
  std::optional<double> angle_deg;    // of a fold: between each side and the plate; 15 without a height
  std::optional<double> diameter_mm;  // of a cylinder, twice the plate without it and without a height; of a
                                      // dome, else it rises by 0.15 of the plate's radius
  std::optional<double> length_mm;  // of a wave, crest to crest: half the plate, at least 4 times its height
  double direction_deg = 90;        // of the straight lines, counter-clockwise from the x axis: upright
  bool is_hollow = false;           // turned over: a valley, a trough, a bowl
  bool is_mirrored = false;         // left and right swapped
  std::shared_ptr<const HeightGrid> image;  // of an image; height_mm is a tenth of the plate without one
};

// Returns the base of a text like "wave", "wave:height=3,length=40" or "dome:diameter=90,hollow". Errors:
// kind option for any other text.
Result<BaseOptions> parse_base(std::string_view text);

// A base over one plate. Its height in the plate's middle is 0.
class Base {
 public:
  // A plane.
  Base() = default;

  // Returns the base over the plate of that outline, whose box is its middle and size. An image covers the
  // plate; what sticks out is cut off. Errors: kind option for a number out of its range, for two that
  // contradict each other, for a surface (no image) steeper than 80 degrees somewhere on the plate, for an
  // image that is missing or smaller than 2 x 2 or has values that are not finite.
  static Result<Base> over(const BaseOptions& options, std::span<const Vec2> outline);

  bool is_plane() const { return kind_ == BaseKind::plane; }

  // In mm, of a place in the outline's coordinates.
  double height(const Vec2& place) const;

  // Its change in x and in y, in mm per mm. Continuous but across the ridge of a fold.
  Vec2 slope(const Vec2& place) const;

  // A length over which it bends one way only, about; infinite for most.
  double feature_mm() const { return feature_mm_; }

  // The share of the way from a to b where a ridge is crossed; nothing if none is.
  std::optional<double> ridge_between(const Vec2& a, const Vec2& b) const;

 private:
  class Image;

  Vec2 from_middle(const Vec2& place) const;
  double profile(const Vec2& p) const;  // of what is highest in the middle
  Vec2 profile_slope(const Vec2& p) const;
  Result<void> shape_fold(const BaseOptions& options, double reach);
  Result<void> shape_wave(const BaseOptions& options, double reach);
  Result<void> shape_round(const BaseOptions& options, double reach);
  Result<void> lay_image(const BaseOptions& options, const Vec2& size);

  BaseKind kind_ = BaseKind::plane;
  Vec2 middle_ = Vec2::Zero(), across_ = Vec2::UnitX();
  double size_ = 0;  // a fold's slope, a wave's amplitude, a radius
  double wave_number_ = 0;
  double sign_ = 1, mirror_ = 1;
  double feature_mm_ = std::numeric_limits<double>::infinity();
  std::shared_ptr<const Image> image_;
};

}  // namespace relievo
