// Makes the plate and the body that the options of a relief describe.
#pragma once

#include "relievo/options.h"
#include "relievo/plate/simplify.h"
#include "relievo/plate/solid.h"

namespace relievo {

// Returns whether left and right are swapped in this form.
bool is_mirrored(Form form);

// Returns whether the solid must be simplified after sampling.
inline bool is_simplified(const ReliefOptions& options) {
  return options.tolerance_mm || options.triangles;
}

// Returns width and height of the plate in millimetres; 0 if they follow from the relief.
Vec2 plate_size_of(const ReliefOptions& options);

// Returns the plate options for a relief of that height. The options have passed check(); if they ask for
// simplification, `triangles` limits those of the front.
PlateOptions plate_of(const ReliefOptions& options, double relief_mm);

// Returns the limits for simplifying the front, less the share of the tolerance that a curved base takes. The
// options must ask for simplification.
SimplifyOptions simplest_front(const ReliefOptions& options);

// Returns whether make_plate() must simplify: this is so on curved ground, whose triangles are not the
// front's.
bool is_simplified_as_plate(const ReliefOptions& options);

// A solid, and the same solid before it was bent around a wrap.
struct Body {
  Solid solid;
  Solid flat = {};  // empty without a wrap
  std::optional<Wrap> wrap = {};

  const Solid& plate() const { return wrap ? flat : solid; }
};

// Returns the body with that front; `relief_mm` is the relief's height. Errors: kind option for a rim that
// does not lean as the draft asks; those of make_plate(), enforce_draft_in_float() and wrap_plate().
Result<Body> make_body(const HeightFieldMesh& front, double relief_mm, const ReliefOptions& options);

}  // namespace relievo
