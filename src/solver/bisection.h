// Cuts a planar graph in two along a short line of vertices. Tested by tests/solver/dissection_test.cpp.
#pragma once

#include <span>

#include "solver/vertex_separator.h"

namespace relievo::solver {

struct Bisection {
  std::vector<Side> side;                      // per vertex; no edge joins the first side to the second
  Index first = 0, second = 0, separator = 0;  // numbers of vertices
};

// Returns a bisection with few vertices in the separator and sides of similar size. `positions`, one per
// vertex, only guide the search: the shortest separator is found in a straight band across the direction in
// which they spread most. If they are of no use (coincident points, positions unrelated to the graph),
// distances in the graph replace them. A side may be empty if nothing better was found.
Bisection bisect(const Graph& graph, std::span<const Eigen::Vector2f> positions);

}  // namespace relievo::solver
