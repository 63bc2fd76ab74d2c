// Draws plates of any outline, on any base or around a wrap, with or without a rim, whose relief changes from frame to
// frame.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "picture/bent_points.h"
#include "picture/body.h"
#include "picture/draw_body.h"
#include "relievo/core/error.h"
#include "relievo/picture/render.h"

namespace relievo {

class LivePlate {
 public:
  // Makes the plate of a surface; `mm_per_unit` is the length of the surface's unit. Mirrors the relief or makes a die
  // of it if the options say so. A plate without ground must have a plane base and no wrap. Errors: those of
  // make_plate() and wrap_plate(), except the error of a plate that would reach the wrap's axis.
  static Result<LivePlate> make(const Surface& surface, const PlateOptions& plate, double mm_per_unit);

  // Returns whether the plate was made with these options. If the picture need not be exact, the height of the rim
  // may differ. The plate then has the bevel of the other height; if the rim is a die's groove, also another size.
  bool serves(const PlateOptions& plate, double mm_per_unit, bool is_exact) const;

  // Returns the body with that relief and a rim of that height. It is valid until the next call. Errors: kind option if
  // the body would reach the axis of its wrap.
  Result<DrawnBody> body(const Shown& shown, double rim_mm);

  // Returns the smallest box around the origin that contains the last body.
  Vec3 size_around_ground() const;
  // Returns the size of the last body, and the middle of its relief relative to the middle of the body.
  PlacedRelief placed() const;

  DrawCache cache;

 private:
  Vec2 find_places(const Solid& solid);
  void find_added_points(const Solid& solid);
  void find_base(const Solid& solid, const Base& base);
  void find_wrap(Solid solid, const Wrap& wrap);
  Vec3f normal_on_base(std::size_t i, const Vec3f& normal, float stretch) const;
  void bend(DrawnBody& body, float bottom);

  // A point between three others of the relief, from which it gets its height and its normal.
  struct AddedPoint {
    Index point;
    std::array<Index, 3> from;
    std::array<float, 3> share;
  };

  PlateOptions options_;
  double mm_per_unit_ = 1;
  std::vector<Triangle> triangles_;
  PlateParts parts_;
  std::vector<Index> relief_;      // the surface's points that the plate shows; they come first
  std::vector<AddedPoint> added_;  // points of the relief that are not points of the surface
  std::vector<Vec2> places_;       // points of the front from the middle of the body, in mm; bent by body()
  std::vector<float> base_;        // heights of the base under the points of the front; empty for a plane
  std::vector<Vec2f> slopes_;      // slopes of the base under these points; empty for a plane
  std::vector<float>
      rise_;  // heights above the base of the points that follow relief_, for a rim of height 1
  std::vector<Vec2> below_;         // points of the bottom
  std::optional<BentPoints> bent_;  // the points of front and bottom around a wrap
  Vec2 half_ = Vec2::Zero(), relief_middle_ = Vec2::Zero();
  std::vector<float> heights_;
  std::vector<Vec3f> normals_;
  Box box_ = {};  // box of the last body
};

}  // namespace relievo
