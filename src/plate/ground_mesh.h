// Flat ground in even triangles, fine enough to follow a deformation. Tested by plate_base_test.
#pragma once

#include <span>
#include <vector>

#include "plate/deformation.h"
#include "relievo/plate/solid.h"

namespace relievo {

// Returns the spacing in mm of points at height z within the convex polygon for which their deformed
// triangles are about within the tolerance. The spacing gives at most about 200,000 points, and is at most a
// quarter of the diagonal of the polygon's box.
double ground_spacing(const Deformation& deformation, std::span<const Vec2> polygon, double z,
                      double tolerance_mm);

// Returns the convex polygon with points between its corners, at most `spacing` apart. The new points are
// moved outwards by up to 0.00001 mm, see convexity_offset(), so that they are corners, too.
std::vector<Vec2> subdivided(std::span<const Vec2> polygon, double spacing);

// Fills the convex polygon with flat triangles that face down, through points `spacing` apart.
void fill_below(Solid& solid, const IndexPolygon& polygon, double spacing);

// Adds the corners of the convex polygon `rim_inner` to the placed front, and points between it and the
// relief, `spacing` apart, at the height of the ground, and triangulates all within the polygon. The relief's
// triangles stay, unless those with points on one circle have to change to fit the ground; the rest becomes
// ground. `front` is the same front before it was placed. Returns the polygon's points. If the relief's
// triangles are not a Delaunay triangulation, it returns none and changes nothing.
IndexPolygon fill_ground(Solid& placed, const HeightFieldMesh& front, std::span<const Vec2> rim_inner,
                         double spacing);

}  // namespace relievo
