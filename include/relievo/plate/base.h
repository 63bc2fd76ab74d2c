// Defines bases, which are surfaces under a relief, given as heights above the plane of its plate.
#pragma once

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "relievo/core/choice.h"
#include "relievo/core/error.h"
#include "relievo/core/image.h"
#include "relievo/core/types.h"

namespace relievo {

enum class BaseKind {
  plane,
  fold,      // two planes that meet in a ridge
  wave,      // a cosine
  cylinder,  // the outside of a cylinder lying on the plate
  dome,      // the cap of a sphere
  image      // a height map
};

inline constexpr std::array<Choice<BaseKind>, 6> base_choices{{{"plane", BaseKind::plane},
                                                               {"fold", BaseKind::fold},
                                                               {"wave", BaseKind::wave},
                                                               {"cylinder", BaseKind::cylinder},
                                                               {"dome", BaseKind::dome},
                                                               {"image", BaseKind::image}}};

// A base is highest in the middle of the plate, or lowest there if it is hollow. Fold, wave and cylinder are
// straight in one direction.
struct BaseOptions {
  BaseKind kind = BaseKind::plane;
  // Difference between the highest and the lowest point, on the plate or in the image. The default for an
  // image is a tenth of the plate's longer side.
  std::optional<double> height_mm;
  // For a fold: angle between each half and the plate. The default without height_mm is 15 degrees.
  std::optional<double> angle_deg;
  // Diameter of a cylinder or a dome. Without height_mm, the default for a cylinder is twice the plate's
  // extent across the cylinder's axis; the default for a dome makes the dome 0.15 of the plate's radius high.
  std::optional<double> diameter_mm;
  // For a wave: distance from crest to crest. The default is half the plate's extent across the waves, but at
  // least four times height_mm.
  std::optional<double> length_mm;
  double direction_deg = 90;  // direction of the straight lines, counter-clockwise from x; 90 is vertical
  bool is_hollow = false;     // whether the base is upside down: a valley, a trough or a bowl
  bool is_mirrored = false;   // whether left and right are swapped
  // For an image: heights in any unit.
  std::shared_ptr<const Image<float>> image;

  bool operator==(const BaseOptions&) const = default;  // images are equal only if they are the same object
};

// Returns the base described by a text such as "wave", "wave:height=3,length=40" or
// "dome:diameter=90,hollow". Errors: kind option for any other text.
Result<BaseOptions> parse_base(std::string_view text);

// The base under one plate. Its height in the plate's middle is 0.
class Base {
 public:
  // A plane at height 0.
  Base() = default;

  // Returns the base under a plate with that outline. The outline's bounding box determines the base's middle
  // and size. An image is scaled until it covers the plate; the rest of the image is cut off. Errors: kind
  // option for a number out of range and for numbers that contradict each other; for a base that is steeper
  // than 80 degrees somewhere on the plate, unless it is an image; for an image that is missing, is smaller
  // than 2 x 2, or has values that are not finite.
  static Result<Base> over(const BaseOptions& options, std::span<const Vec2> outline);

  bool is_plane() const { return kind_ == BaseKind::plane; }

  // Returns the height in mm at a position in the outline's coordinates.
  double height(const Vec2& place) const;

  // Returns an approximate length in mm within which the base is only convex or only concave; infinity if the
  // whole base is only convex or only concave.
  double min_feature_mm() const { return min_feature_mm_; }

  // Returns the position, in (0, 1), where the segment from a to b crosses the ridge of a fold; nothing if it
  // crosses none.
  std::optional<double> ridge_between(const Vec2& a, const Vec2& b) const;

 private:
  class ImageSurface;

  Vec2 from_middle(const Vec2& place) const;
  double profile(const Vec2& p) const;  // the height of the base if it were not hollow
  Result<void> shape_fold(const BaseOptions& options, double half_extent);
  Result<void> shape_wave(const BaseOptions& options, double half_extent);
  Result<void> shape_round(const BaseOptions& options, double half_extent);
  Result<void> lay_image(const BaseOptions& options, const Vec2& size);

  BaseKind kind_ = BaseKind::plane;
  Vec2 middle_ = Vec2::Zero(), across_ = Vec2::UnitX();
  double size_ = 0;  // a fold's slope, a wave's amplitude, or a radius in mm
  double wave_number_ = 0;
  double sign_ = 1, mirror_ = 1;
  double min_feature_mm_ = std::numeric_limits<double>::infinity();
  std::shared_ptr<const ImageSurface> image_;
};

}  // namespace relievo
