// Triangulations that have given edges, such as the walls of letters. Tested by
// tests/geometry/held_edges_test.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "relievo/core/types.h"
#include "relievo/geometry/triangulation.h"

namespace relievo {

using EdgeEnds = std::array<Index, 2>;

// A triangulation, and for each wanted edge whether it has it.
struct HeldTriangulation {
  Triangulation mesh;
  std::vector<std::uint8_t> is_held;
};

// Returns the Delaunay triangulation of the points in which edges have been flipped until it has the wanted
// edges; other edges stay locally Delaunay where the wanted ones allow it. An edge is not held if an earlier
// one crosses it, or if a third point lies on it. Each edge takes time for the edges that it crosses.
HeldTriangulation delaunay_with(std::span<const Vec2> points, std::span<const EdgeEnds> wanted);

}  // namespace relievo
