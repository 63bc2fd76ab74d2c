// Adds letters, borders and drawings to the level ground of a plate.
#pragma once

#include <span>

#include "geometry/raised_shape.h"
#include "lettering/ornament_shapes.h"
#include "plate/plate_ground.h"
#include "relievo/plate/solid.h"

namespace relievo {

// Returns the area for ornaments on a plate of the given outline.
OrnamentFrame ornament_frame(const PlateOutline& outline, const PlateOptions& options);

// Replaces the level ground of a surface by ground with the shapes on it. The shapes are in the surface's coordinates.
// `inner` is the polygon inside the rim. Triangles that are not ground are kept. Sets `surface.ornaments`. Errors: kind
// option if a shape touches the relief, the rim or another shape, or if the surface has no level ground.
Result<void> add_shapes(Solid& surface, std::span<const RaisedShape> shapes, std::span<const Vec2> inner);

}  // namespace relievo
