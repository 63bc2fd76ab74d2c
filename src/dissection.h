// An order of elimination for planar graphs: geometric nested dissection.
#pragma once

#include "solver/graph.h"

namespace relievo {

// Returns the vertices in an order of elimination that fills little: separators last, the pieces they leave
// before them, recursively; small pieces by minimum degree. `positions` (finite, one per vertex) only steer:
// bad ones cost fill. Faster if near vertices have near numbers. Same result for any number of threads.
std::vector<Index> dissection_order(const Graph& graph, std::span<const Eigen::Vector2f> positions);

}  // namespace relievo
