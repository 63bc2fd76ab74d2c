// The shape of a plate, seen from the front.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "relievo/core/error.h"
#include "relievo/core/types.h"

namespace relievo {

enum class Outline {
  rectangle,
  round,  // a rectangle with round corners
  circle,
  ellipse,
  hexagon,  // regular, flat above or pointed, whichever is smaller
  none      // the relief alone, without any ground
};

struct OutlineOptions {
  Outline outline = Outline::rectangle;
  double corner_mm = 5;  // radius of `round`; at most half the shorter side counts
  double margin_mm = 5;  // least distance from the enclosed points to the outline
};

// Returns the outline of that name. Errors: kind option for any other name.
Result<Outline> parse_outline(std::string_view name);

// Returns the outline around points of the plane: a convex polygon, counter-clockwise, whose edges have at
// least the margin from every point. Curves are polygons around the curve, nowhere further than 0.01 mm from
// it, and are as wide and as high as the curve. All but `round` are as small as they can be around their
// centre: that of the points' box for a rectangle, of the smallest circle (ellipse) around the points for the
// others, near enough that they are at most 1 % too large. Rounded corners that would cut into the margin
// move the sides out. Empty for no points and for `none`.
std::vector<Vec2> outline_around(std::span<const Vec2> points, const OutlineOptions& options);

}  // namespace relievo
