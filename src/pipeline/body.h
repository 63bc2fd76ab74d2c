// Makes the front, the plate and the body that the options of a relief ask for.
#pragma once

#include "relievo/core/progress.h"
#include "relievo/options.h"
#include "relievo/plate/simplify.h"
#include "relievo/plate/solid.h"
#include "relievo/relief/relief.h"

namespace relievo {

// Returns whether left and right are swapped in this form.
bool is_mirrored(Form form);

// Returns whether the solid must be simplified after sampling.
inline bool is_simplified(const ReliefOptions& options) {
  return options.tolerance_mm || options.triangles;
}

// Returns width and height of the plate in millimetres; 0 if they follow from the relief.
Vec2 plate_size_of(const ReliefOptions& options);

// Returns the plate options for a relief of that height. The options have passed check(). If they ask for
// simplification, `options.triangles` is here the limit for the triangles of the front, not of the solid.
PlateOptions plate_of(const ReliefOptions& options, double relief_mm);

// Returns the limits for simplifying the front. The tolerance excludes the share that a curved base takes.
// The options must ask for simplification.
SimplifyOptions simplest_front(const ReliefOptions& options);

// Returns whether make_plate() must simplify, and not simplified_front(). If the options ask for
// simplification, this is so on curved ground, because the triangles of the ground are not triangles of the
// front, and for the finish `reachable`. It is never so for the outline `none`.
bool is_simplified_as_plate(const ReliefOptions& options);

// Returns options with a width with a height in mm in the place of one that is a share of the diagonal.
ReliefOptions with_height(const Surface& surface, ReliefOptions options);

// A solid, and the same solid before it was bent around a wrap.
struct Body {
  Solid solid;
  Solid flat = {};  // empty without a wrap
  std::optional<Wrap> wrap = {};

  const Solid& plate() const { return wrap ? flat : solid; }
};

// Returns the body with that front; `relief_mm` is the relief's height. Errors: kind option for a rim that
// leans less than the draft angle requires; those of make_plate(), enforce_draft_in_float() and wrap_plate().
Result<Body> make_body(const HeightFieldMesh& front, double relief_mm, const ReliefOptions& options);

struct FormedFront {
  HeightFieldMesh front;
  double height_mm = 0;                // lowest to highest point
  double simplification_error_mm = 0;  // largest difference to the front with all samples
  std::size_t full_triangles = 0;      // triangles of the front with all samples
};

// Returns the heights in millimetres of the base under the points of an upright front; empty for a plane.
// Errors: those of plate_base().
Result<std::vector<double>> base_heights_mm(const HeightFieldMesh& front, const ReliefOptions& options);

// Returns the surface's triangles as a front in millimetres, with its points at these heights.
HeightFieldMesh front_in_mm(const Surface& surface, const std::vector<double>& heights, double mm_per_unit);

// Returns the front before simplification, in the form `options.form`. Errors: kind cancelled.
Result<FormedFront> full_front(const Surface& surface, const Relief& relief, const ReliefOptions& options,
                               const Progress* progress);

// Returns the front, simplified as the options ask unless make_plate() will simplify it. With the outline
// `none`, the result is only the relief. Errors: those of simplify().
Result<FormedFront> simplified_front(FormedFront full, const ReliefOptions& options, Progress* progress);

// Returns the depth of the front's lowest point below the ground: 0 or more.
double depth_below_ground(const HeightFieldMesh& front);

// A front, simplified if the options ask for it, and the body made from it. If the options give a number of
// triangles, the body's solid has at most that many.
struct FormedBody {
  FormedFront formed;
  Body body;
};

// Returns the body with that front, which is simplified as the options ask. Errors: those of
// simplified_front() and make_body(); kind option for fewer triangles than the solid needs for its outline
// and its walls.
Result<FormedBody> make_formed_body(FormedFront full, const ReliefOptions& options, Progress* progress);

}  // namespace relievo
