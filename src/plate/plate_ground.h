// Makes the ground around a relief. It consists of rings between convex polygons, and of flat ground of
// regular triangles that are small enough to follow a deformation. Tested by solid_test and plate_base_test.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "plate/deformation.h"
#include "relievo/plate/solid.h"

namespace relievo {

// Returns the spacing in mm for points at height z, such that after the deformation their triangles
// deviate by at most about the tolerance. `polygon` is convex. The spacing is at most a quarter of the
// diagonal of the polygon's box. It is never so small that more than about 200,000 points are needed.
double ground_spacing(const Deformation& deformation, std::span<const Vec2> polygon, double z,
                      double tolerance_mm);

// Returns the convex polygon with additional points on its sides, at most `spacing` apart. The additional points are
// moved outwards by up to 0.00001 mm (convexity_offset()), so that they are corners of the polygon, too.
std::vector<Vec2> subdivided(std::span<const Vec2> polygon, double spacing);

// Fills the convex polygon with flat triangles that face down. Their points are `spacing` apart.
void fill_below(Solid& solid, const IndexPolygon& polygon, double spacing);

// Fills the convex polygon `rim_inner` around the placed front. Adds the polygon's corners, and points
// between the polygon and the relief, `spacing` apart, all at the height of the ground. Triangulates
// everything within the polygon. Triangles that are not part of the relief are ground. The relief's triangles
// are kept, except that points on a common circle may be triangulated differently to match the ground.
// `front` is the same front before it was placed. Returns the polygon's points. If the relief's triangles are
// not a Delaunay triangulation, returns no points and changes nothing.
IndexPolygon fill_ground(Solid& placed, const HeightFieldMesh& front, std::span<const Vec2> rim_inner,
                         double spacing);

// Adds the polygon's corners to the solid's points, at height z. Returns the new points.
IndexPolygon add_polygon(Solid& solid, const std::vector<Vec2>& corners, double z);

// Fills the ring between two convex polygons; the inner one is strictly inside the outer one. Every triangle
// has an area, even where corners are collinear or edges are parallel.
void add_ring(Solid& solid, IndexPolygon inner, IndexPolygon outer);

// Returns the outward offset that turns a point on a polygon's side into a corner. The point is at `share` of
// the side. With these offsets the points of a side lie on an arc. The middle of the arc is 0.00001 mm
// outside a side of 100 mm. Without the offsets, collinear corners would give triangles without area, and an
// ambiguous hull of the Delaunay triangulation.
inline Vec2 convexity_offset(const Vec2& side, double share) {
  const double curvature = 8e-9;  // per mm
  return share * (1 - share) / 2 * curvature * side.norm() * Vec2(side.y(), -side.x());
}

// The outline of a plate with ground. The lower left corner of its box is the origin.
struct PlateOutline {
  std::vector<Vec2> polygon;         // convex, counter-clockwise
  Vec2 front_corner = Vec2::Zero();  // the lower left corner of the front's box
};

PlateOutline outline_of_plate(const HeightFieldMesh& front, const Box& box, const PlateOptions& options);

// An edge of the rim. The outermost one is the outline of the plate.
struct RimEdge {
  std::vector<Vec2> polygon;
  double height_mm = 0;  // above the ground
};

// Returns the rim's edges, from the innermost edge to the outline; only the outline if there is no rim.
std::vector<RimEdge> rim_edges(const PlateOutline& outline, const RimOptions& rim);

// Returns the polygon inside the rim; the outline itself if there is no rim.
std::vector<Vec2> rim_inner_polygon(const PlateOutline& outline, const RimOptions& rim);

struct GroundOptions {
  RimOptions rim;
  // Distance between points added on outline and ground; infinity adds no points.
  double spacing = std::numeric_limits<double>::infinity();
};

// Adds the ground, with its regions, to the placed front. Returns the outline's points. If the
// spacing is finite, points at that distance are added along the outline. They are also added on the
// ground, if the front's triangles allow it (fill_ground()).
IndexPolygon add_ground(Solid& solid, const HeightFieldMesh& front, const PlateOutline& outline,
                        const GroundOptions& options);

}  // namespace relievo
