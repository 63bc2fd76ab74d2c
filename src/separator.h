// Cuts a planar graph in two along a thin line of vertices.
#pragma once

#include <span>

#include "band_cut.h"

namespace relievo {

struct Separation {
  std::vector<Side> side;                      // per vertex; no edge joins the first side to the second
  Index first = 0, second = 0, separator = 0;  // how many vertices of each
};

// Returns a separation with few vertices in the separator and sides of similar size. `positions` steer: lines
// across several directions are tried, each with leeway on both sides for the separator to bend. Where they
// do not help (points that coincide, positions that have nothing to do with the graph), distance in the graph
// takes their place. A side may be empty if nothing better was found.
Separation separate(const Graph& graph, std::span<const Eigen::Vector2f> positions);

}  // namespace relievo
