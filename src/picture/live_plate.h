// A plate of any outline, with or without a rim, whose relief changes from frame to frame.
#pragma once

#include <vector>

#include "picture/body.h"
#include "picture/draw_body.h"
#include "relievo/core/error.h"
#include "relievo/picture/render.h"

namespace relievo {

class LivePlate {
 public:
  // Makes the plate of a surface whose unit has that length, with a relief of height 0. The base must be a plane, and
  // the plate must have ground. Errors: those of make_plate().
  static Result<LivePlate> make(const Surface& surface, const PlateOptions& plate, double mm_per_unit);

  // Returns whether the plate is that of these options. A quick picture may also show a rim whose bevel belongs to
  // another height.
  bool serves(const PlateOptions& plate, double mm_per_unit, bool is_exact) const;

  // Returns the body with that relief and a rim of that height. It is valid until the next call.
  DrawnBody body(const Shown& shown, double rim_mm);

  // Returns the smallest box around the origin that contains the last body.
  Vec3 size_around_ground() const;
  // Returns the size of the last body, and where the middle of its relief lies from the middle of the body.
  PlacedRelief placed() const;

  DrawCache cache;

 private:
  PlateOptions options_;
  double mm_per_unit_ = 1;
  std::vector<Triangle> triangles_;
  PlateParts parts_;
  std::size_t relief_points_ = 0;  // points of the surface, which come first
  std::vector<Vec2> places_;       // points of the front from the middle of the plate, in mm
  std::vector<float> rise_;        // of the points behind those of the surface, for a rim of height 1
  std::vector<Vec2> below_;        // points of the bottom
  Vec2 half_ = Vec2::Zero(), relief_middle_ = Vec2::Zero();
  std::vector<float> heights_;
  std::vector<Vec3f> normals_;
  Box front_ = {};
};

}  // namespace relievo
