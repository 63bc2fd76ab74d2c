// Fine triangles where flat ones are to follow a curved surface.
#pragma once

#include <functional>
#include <limits>
#include <optional>

#include "plate_rings.h"
#include "relievo/plate/solid.h"

namespace relievo {

// What becomes of a flat body.
struct Bend {
  std::function<Vec3(const Vec3&)> at;  // where a point of the flat body goes
  // The share of the way between two of its points where the bent way has a corner.
  std::function<std::optional<double>(const Vec3&, const Vec3&)> corner_between = nullptr;
  double feature_mm = std::numeric_limits<double>::infinity();  // over which it bends one way only, about
};

// Cuts the triangles, which stay flat, until each, its corners bent, is nowhere further than the tolerance
// from what its inside is bent to, but for edges below 0.004 mm. New triangles take the place of theirs, with
// their region, and new points are the last ones; those that fall on `outline` become part of it. Returns the
// largest distance that is left, as measured on edges and inside.
double refine(Solid& flat, Loop& outline, const Bend& bend, double tolerance_mm);

}  // namespace relievo
