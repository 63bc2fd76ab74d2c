// A smallest vertex separator inside a band of a graph, by maximum flow.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/graph.h"

namespace relievo {

enum class Side : std::uint8_t { first, second, separator };

// The part of a graph in which a separator is sought: what lies on the first side of it is joined to the band
// at the vertices of `touches_first`, what lies on the second at those of `touches_second`. Where the graph
// is drawn in the plane without crossings and its neighbours stand counter-clockwise, the search takes linear
// time; else it takes longer.
struct Band {
  Graph graph;
  std::vector<Eigen::Vector2f> positions;
  Eigen::Vector2f direction;  // from the first side to the second
  std::vector<std::uint8_t> touches_first, touches_second;
};

// Two separators with as few vertices as possible: the one nearest the first side and the one nearest the
// second. A side per vertex of the band.
struct BandCuts {
  std::vector<Side> near_first, near_second;
};

// Menger: as many vertices separate the sides as vertex-disjoint paths join them. In the plane, taking the
// uppermost path again and again finds nearly all of them; augmenting paths (Dinic) find the rest.
BandCuts smallest_cuts(const Band& band);

}  // namespace relievo
