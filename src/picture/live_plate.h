// A plate of any outline, on any base or around a wrap, with or without a rim, whose relief changes from frame to frame.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "picture/body.h"
#include "picture/draw_body.h"
#include "relievo/core/error.h"
#include "relievo/core/types.h"
#include "relievo/picture/render.h"
#include "relievo/plate/wrap.h"

namespace relievo {

class BentPoints {
 public:
  // Prepares the points at these places of the flat plate, in the coordinates of Wrap::at().
  BentPoints(const Wrap& wrap, std::span<const Vec2> places);

  const Wrap& wrap() const { return wrap_; }

  // Returns the bent position of point i at this height above the ground. A wrap moves a point along a straight line
  // as its height changes.
  Vec3f at(std::size_t i, float height_mm) const { return points_[i].at + height_mm * points_[i].out; }

  // Returns the unit normal at point i of a relief that has this height and this normal on the flat plate.
  Vec3f normal(std::size_t i, float height_mm, const Vec3f& flat) const;

 private:
  // A position on the ground, and the direction in which heights are measured there, with their derivatives by x and y.
  struct Point {
    Vec3f at, out, at_by_x, at_by_y, out_by_x, out_by_y;
  };
  Wrap wrap_;
  std::vector<Point> points_;
};

class LivePlate {
 public:
  // Makes the plate of a surface; `mm_per_unit` is the length of the surface's unit. Mirrors the relief or makes a die
  // of it if the options say so. A plate without ground must have a plane base and no wrap. Errors: those of
  // make_plate() and wrap_plate(), except that the wrap's axis is too near.
  static Result<LivePlate> make(const Surface& surface, const PlateOptions& plate, double mm_per_unit);

  // Returns whether the plate was made with these options. For a quick picture, the plate's rim may have the bevel of
  // another height, which for a die's groove also changes the plate's size.
  bool serves(const PlateOptions& plate, double mm_per_unit, bool is_exact) const;

  // Returns the body with that relief and a rim of that height. It is valid until the next call. Errors: kind option if
  // the body would reach the axis of its wrap.
  Result<DrawnBody> body(const Shown& shown, double rim_mm);

  // Returns the smallest box around the origin that contains the last body.
  Vec3 size_around_ground() const;
  // Returns the size of the last body, and where the middle of its relief lies from the middle of the body.
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
  std::vector<Index> relief_;      // points of the surface that the plate shows, which come first
  std::vector<AddedPoint> added_;  // points of the relief that the surface does not have
  std::vector<Vec2> places_;       // points of the front from the middle of the body, in mm; bent by body()
  std::vector<float> base_;        // heights of the base under the points of the front; empty for a plane
  std::vector<Vec2f> slopes_;      // slopes of the base under them; empty for a plane
  std::vector<float>
      rise_;  // heights above the base of the points after those of the surface, for a rim of height 1
  std::vector<Vec2> below_;         // points of the bottom
  std::optional<BentPoints> bent_;  // the points of front and bottom around a wrap
  Vec2 half_ = Vec2::Zero(), relief_middle_ = Vec2::Zero();
  std::vector<float> heights_;
  std::vector<Vec3f> normals_;
  Box box_ = {};  // of the last body
};

}  // namespace relievo
