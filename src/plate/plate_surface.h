// Makes the front side of a plate: relief, ground and rim. Walls and bottom are added elsewhere.
// Tested by plate_base_test.
#pragma once

#include <limits>
#include <span>

#include "geometry/raised_shape.h"
#include "geometry/weld.h"
#include "lettering/ornament_shapes.h"
#include "plate/plate_ground.h"
#include "relievo/plate/solid.h"
#include "relievo/plate/tool.h"

namespace relievo {

// The front side of a plate, an open surface. Its z does not include the plate's thickness yet.
struct PlateSurface {
  Solid solid;                                               // without walls and bottom
  IndexPolygon outline;                                      // empty if the plate has no ground
  double spacing = std::numeric_limits<double>::infinity();  // distance between points on the bottom
};

// Light grey, the colour of ground, walls and bottom under a coloured relief.
inline constexpr Colour plate_colour = {200, 200, 200};

// Gives plate_colour to the points after those that already have a colour.
void fill_colours(Solid& solid);

// Returns the base under a front, in the front's coordinates. For a plate without ground, the front must
// consist of the relief alone. Errors: those of Base::over().
Result<Base> base_under(const HeightFieldMesh& front, const PlateOptions& options);

// Returns the surface of a plate on its base. For a wrap the surface is flat, and its triangles are small
// enough to be bent. Errors: those of Wrap::around() and simplify().
Result<PlateSurface> make_plate_surface(const HeightFieldMesh& front, const Base& base,
                                        const PlateOptions& options);

// Checks the options' lengths and the front. Errors: those of make_plate().
Result<void> check_plate(const HeightFieldMesh& front, const PlateOptions& options);

// Replaces the surface by the surface that the tool leaves, see close_by_tool(). Points that the tool reaches
// are kept. The others are replaced by samples of the new surface. Samples are dense where this surface is
// steep; level ground gets none. `edges` are the rim's edges in the surface's coordinates; points along these
// edges keep the rim sharp. A surface without ground keeps its triangles, and only its points are lifted.
void make_reachable(PlateSurface& surface, const Tool& tool, std::span<const RimEdge> edges);

// Returns the area for ornaments on a plate of the given outline.
OrnamentFrame ornament_frame(const PlateOutline& outline, const PlateOptions& options);

// Replaces the level ground of a surface by ground with the shapes on it. The shapes are in the surface's coordinates.
// `inner` is the polygon inside the rim. Triangles that are not ground are kept. Sets `surface.ornaments`. Errors: kind
// option if a shape touches the relief, the rim or another shape, or if the surface has no level ground.
Result<void> add_shapes(Solid& surface, std::span<const RaisedShape> shapes, std::span<const Vec2> inner);

// Returns an error of kind option if a plate would reach the wrap's axis. The plate's bottom lies `bottom_mm`
// below the ground, and its highest point lies `highest_mm` above the ground.
Result<void> check_room(const Wrap& wrap, double bottom_mm, double highest_mm);

// Returns an error of kind option if the plate goes all the way around, but has no two straight and equal sides that
// can meet.
Result<void> check_closed(const PlateOptions& options, const Wrap& wrap);

}  // namespace relievo
