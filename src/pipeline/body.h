// The plate and the body that the options of a relief ask for.
#pragma once

#include "relievo/options.h"
#include "relievo/plate/simplify.h"
#include "relievo/plate/solid.h"

namespace relievo {

// Returns whether left and right are swapped in this form.
bool is_mirrored(Form form);

// Returns whether the solid is to have fewer triangles than its samples give.
inline bool is_simplified(const ReliefOptions& options) {
  return options.tolerance_mm || options.triangles;
}

// Returns width and height of the plate in millimetres; 0 where the relief decides them.
Vec2 plate_size_of(const ReliefOptions& options);

// Returns the plate of a relief as high as that. The options have passed check(); if they ask for simplification,
// `triangles` limits those of the front.
PlateOptions plate_of(const ReliefOptions& options, double relief_mm);

// Returns how simple the front may become, if that is asked for; a curved base takes its share of the tolerance.
SimplifyOptions simplest_front(const ReliefOptions& options);

// Returns whether make_plate() is to simplify: on a curved ground, whose triangles are not the front's.
bool is_simplified_as_plate(const ReliefOptions& options);

// A solid, and what it was before it was bent around a body.
struct Body {
  Solid solid;
  Solid flat = {};  // empty without a wrap
  std::optional<Wrap> wrap = {};

  const Solid& plate() const { return wrap ? flat : solid; }
};

// Returns the body with that front, whose relief is as high as that. Errors: kind option for a rim that does not lean
// as the draft asks; those of make_plate(), enforce_draft_in_float() and wrap_plate().
Result<Body> make_body(const HeightFieldMesh& front, double relief_mm, const ReliefOptions& options);

}  // namespace relievo
