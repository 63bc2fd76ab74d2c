// Draws plates whose relief changes from frame to frame. Plates may have any outline, any base or wrap, and a rim.
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
  // Prepares the points at the given positions of the flat plate, in the coordinates of Wrap::at().
  BentPoints(const Wrap& wrap, std::span<const Vec2> places);

  const Wrap& wrap() const { return wrap_; }

  // Returns the bent position of point i if it has the given height above the ground. As its height changes, a point
  // moves along a straight line.
  Vec3f at(std::size_t i, float height_mm) const { return points_[i].at + height_mm * points_[i].out; }

  // Returns the unit normal of the bent relief at point i. On the flat plate, the relief has the given
  // height and the normal `flat` there.
  Vec3f normal(std::size_t i, float height_mm, const Vec3f& flat) const;

 private:
  // A position on the ground, the direction in which heights are measured there, and the derivatives of both with
  // respect to x and y.
  struct Point {
    Vec3f at, out, at_by_x, at_by_y, out_by_x, out_by_y;
  };
  Wrap wrap_;
  std::vector<Point> points_;
};

class LivePlate {
 public:
  // Makes the plate of a surface; `mm_per_unit` is the length of the surface's unit in mm. Mirrors the relief, or makes
  // a die of it, if the options say so. A plate without ground must have a plane base and no wrap. Errors: those of
  // make_plate() and wrap_plate(), except the error that a plate would reach the wrap's axis.
  static Result<LivePlate> make(const Surface& surface, const PlateOptions& plate, double mm_per_unit);

  // Returns whether the plate was made with these options. If the picture need not be exact, the height of
  // the rim may differ. The plate then keeps the bevel of its own rim height; if the rim is a die's groove,
  // the plate also keeps its own size.
  bool serves(const PlateOptions& plate, double mm_per_unit, bool is_exact) const;

  // Returns the body with the relief `shown` and a rim of height `rim_mm`. It is valid until the next call. Errors:
  // kind option if the body would reach the axis of its wrap.
  Result<DrawnBody> body(const Shown& shown, double rim_mm);

  // Returns the size of the smallest box that contains the last body and is centred at the origin.
  Vec3 size_around_ground() const;
  // Returns the size of the last body, and the middle of its relief relative to the body's middle.
  PlacedRelief placed() const;

  DrawCache cache;

 private:
  Vec2 find_places(const Solid& solid);
  void find_added_points(const Solid& solid);
  void find_base(const Solid& solid, const Base& base);
  void find_wrap(Solid solid, const Wrap& wrap);
  Vec3f normal_on_base(std::size_t i, const Vec3f& normal, float stretch) const;
  void bend(DrawnBody& body, float bottom);

  // A point of the relief whose height and normal are weighted means of those of three other points.
  struct AddedPoint {
    Index point;
    std::array<Index, 3> from;
    std::array<float, 3> share;
  };

  PlateOptions options_;
  double mm_per_unit_ = 1;
  std::vector<Triangle> triangles_;
  PlateParts parts_;
  std::vector<Index> relief_;      // indices of the surface's points that are the plate's first points
  std::vector<AddedPoint> added_;  // points of the relief that are not points of the surface
  std::vector<Vec2> places_;       // positions of the front's points, from the middle of the body, in mm
  std::vector<float> base_;        // heights of the base under the points of the front; empty for a plane
  std::vector<Vec2f> slopes_;      // slopes of the base under the points of the front; empty for a plane
  std::vector<float> rise_;        // for the points after relief_: height above the base at a rim of height 1
  std::vector<Vec2> below_;        // points of the bottom
  // The points of front and bottom after the plate is bent around the body of the option wrap; empty for a flat plate.
  std::optional<BentPoints> bent_;
  Vec2 half_ = Vec2::Zero(), relief_middle_ = Vec2::Zero();
  std::vector<float> heights_;
  std::vector<Vec3f> normals_;
  Box box_ = {};  // box of the last body
};

}  // namespace relievo
