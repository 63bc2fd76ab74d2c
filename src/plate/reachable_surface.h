// Makes the front of a plate as a milling tool leaves it. Tested by reachable_surface_test.
#pragma once

#include <span>

#include "plate/plate_ground.h"
#include "plate/plate_surface.h"
#include "relievo/plate/tool.h"

namespace relievo {

// Replaces the surface by the one that the tool leaves above it: see close_by_tool(). Points that the tool
// reaches stay. The others are replaced by samples of the new surface, which are dense where it is steep;
// level ground gets none. `edges` are the rim's, in the surface's coordinates; points along these edges keep
// them sharp. A surface without ground keeps its triangles, and its points are lifted.
void make_reachable(PlateSurface& surface, const Tool& tool, std::span<const RimEdge> edges);

}  // namespace relievo
