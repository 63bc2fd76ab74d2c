// Elimination order of planar graphs by geometric nested dissection.
#pragma once

#include "solver/graph.h"

namespace relievo::solver {

// Returns the vertices in an elimination order that causes little fill. The order is made recursively:
// separators come last, after the two sides; small parts are ordered by minimum degree. `positions` (finite,
// one per vertex) only guide the search: bad ones cost fill, never correctness. The search is faster if
// nearby vertices have similar numbers. The result is the same for any number of threads.
std::vector<Index> dissection_order(const Graph& graph, std::span<const Eigen::Vector2f> positions);

}  // namespace relievo::solver
