// Computes constrained triangulations, which contain given edges, such as the walls of letters.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "relievo/core/types.h"
#include "relievo/geometry/triangulation.h"

namespace relievo {

using EdgeEnds = std::array<Index, 2>;

// A triangulation, and for each wanted edge whether the triangulation contains it.
struct HeldTriangulation {
  Triangulation mesh;
  std::vector<std::uint8_t> is_held;
};

// Returns the Delaunay triangulation of the points, after edges were flipped until it has the wanted edges.
// Other edges stay locally Delaunay if the wanted edges allow it. A wanted edge is missing if an earlier one
// crosses it, or if a third point lies on it. The time for an edge is about proportional to the number of
// edges that it crosses.
HeldTriangulation delaunay_with(std::span<const Vec2> points, std::span<const EdgeEnds> wanted);

}  // namespace relievo
