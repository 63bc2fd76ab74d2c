// Computes outlines, which are the shapes of plates seen from the front.
#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "relievo/core/choice.h"
#include "relievo/core/error.h"
#include "relievo/core/length.h"
#include "relievo/core/types.h"

namespace relievo {

enum class Outline {
  rectangle,
  round,  // a rectangle with round corners
  circle,
  ellipse,
  hexagon,  // regular, with a side or a corner at the top, whichever gives the smaller plate
  none      // only the relief, without ground
};

inline constexpr std::array<Choice<Outline>, 6> outline_choices{{{"rectangle", Outline::rectangle},
                                                                 {"round", Outline::round},
                                                                 {"circle", Outline::circle},
                                                                 {"ellipse", Outline::ellipse},
                                                                 {"hexagon", Outline::hexagon},
                                                                 {"none", Outline::none}}};

struct OutlineOptions {
  Outline outline = Outline::rectangle;
  double corner_mm = 5;  // radius of the corners of `round`, at most half the shorter side
  double margin_mm = 5;  // least distance from the enclosed points to the outline
  // Width and height of the outline, even if they leave less than the margin; 0 for the smallest size that
  // the margin allows. Only for outlines with has_free_size(), and for circles, which use only the width.
  Vec2 size_mm = Vec2::Zero();
};

// Parses width and height, in millimetres, from a text such as "200x150" or "8in x 6in": two lengths (see
// parse_length()) with x or the multiplication sign between them. If only the second length has a unit, it
// applies to both. Errors: kind option for any other text; the error's input is empty, for the caller to fill
// in.
Result<Vec2> parse_plate_size(std::string_view text, LengthUnit bare = LengthUnit::mm);

// Parses a shift to the right and up, in millimetres, from a text such as "10,-5" or "1in,0", with units as
// in parse_plate_size(). Errors: kind option for any other text; the error's input is empty, for the caller
// to fill in.
Result<Vec2> parse_shift(std::string_view text, LengthUnit bare = LengthUnit::mm);

// Returns whether width and height of the outline can be chosen independently: true for rectangles and
// ellipses.
bool has_free_size(Outline outline);

// Returns whether the outline is the bounding box of the points, enlarged by the margin.
bool is_box(Outline outline);

// Returns the outline around points in the plane: a convex polygon, counter-clockwise, whose edges are at
// least the margin away from every point. A curved outline is replaced by a polygon inscribed in the curve;
// then the curve, not the polygon, has the margin. The polygon is as wide and as high as the curve. It
// deviates from the curve by at most a micrometre or a ten-millionth of the curve's radius, whichever is
// more.
//
// Outlines are centred on the bounding box of the points. Circles, ellipses and hexagons are centred only
// horizontally; their vertical position makes the circle or ellipse as small as possible. All outlines but
// `round` are as small as their centre allows. If rounded corners would cut into the margin, the sides are
// moved outwards. If a size is given, the outline has that size and the same centre. The result is empty for
// no points and for `none`.
std::vector<Vec2> outline_around(std::span<const Vec2> points, const OutlineOptions& options);

}  // namespace relievo
