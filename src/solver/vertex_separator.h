// Minimum vertex separators inside a band of a graph, by maximum flow.
// Tested by tests/solver/vertex_separator_test.cpp.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/graph.h"

namespace relievo::solver {

enum class Side : std::uint8_t { first, second, separator };

// The part of a graph in which a separator is sought. Vertices marked in `touches_first` have neighbours on
// the first side of the band, those marked in `touches_second` on the second side. The search takes linear
// time if the positions draw the graph without crossings and each vertex lists its neighbours
// counter-clockwise; otherwise the result is the same, but the search takes longer.
struct SeparatorBand {
  Graph graph;
  std::vector<Eigen::Vector2f> positions;
  Eigen::Vector2f direction;  // from the first side to the second
  std::vector<std::uint8_t> touches_first, touches_second;
};

// Two separators, each with the smallest possible number of vertices: the one nearest to the first side and
// the one nearest to the second. Each gives one side per vertex of the band.
struct MinimumSeparators {
  std::vector<Side> near_first, near_second;
};

// Returns the minimum separators of the band. By Menger's theorem their size is the largest number of
// vertex-disjoint paths between the sides. In the plane, repeatedly taking the uppermost remaining path finds
// nearly all of these paths; augmenting paths (Dinic 1970) find the rest.
MinimumSeparators minimum_separators(const SeparatorBand& band);

}  // namespace relievo::solver
