// Makes reliefs with a given vertical scale, such as tiles of a map, which must match at their edges.
#pragma once

#include <cstdint>
#include <vector>

#include "relievo/options.h"
#include "relievo/plate/solid.h"
#include "relievo/relief/relief.h"
#include "relievo/scan/surface.h"

namespace relievo {

// Returns, per point, whether it is on an edge of a tile. There the relief does not go down to the ground. A
// point is on such an edge if it is on a straight side of the surface's hull, and not at a hole.
std::vector<std::uint8_t> tile_edges(const Surface& surface);

// Returns the relief whose heights are `options.mm_per_value` times the surface's values above the ground.
// Lower values get the height of the ground. Points on the edges of a tile keep their heights. Errors: kind
// option if the surface's depths are not proportional to the values of its file, or if the relief would be
// higher than 1e5 mm; kind geometry if nothing is above the ground.
Result<Relief> relief_of_values(const Surface& surface, const ReliefOptions& options, double mm_per_unit);

// Adds nearly vertical walls under the edges of a tile, because the hull of a front must be on the ground.
// Each point on an edge gets a copy with the point's height, about a hundredth of a millimetre further
// inside. The walls are appended to the front's triangles.
void raise_walls(HeightFieldMesh& front, const Surface& surface);

}  // namespace relievo
