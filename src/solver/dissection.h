// Finds elimination orders of planar graphs by geometric nested dissection. A separator, a short line of vertices,
// divides a graph in two. A maximum flow finds the shortest separator inside a band. Tested by
// tests/solver/dissection_test.cpp and tests/solver/vertex_separator_test.cpp.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "relievo/core/types.h"

namespace relievo::solver {

// An undirected graph in compressed sparse rows. The neighbours of vertex v are to[begin[v]] up to, but not
// including, to[begin[v + 1]]. Every edge is stored at both of its ends. There are no loops. `begin` has one
// element more than there are vertices.
struct Graph {
  std::vector<Index> begin = {0};
  std::vector<Index> to;

  Index size() const { return static_cast<Index>(begin.size() - 1); }
  std::span<const Index> neighbours(Index v) const {
    return {to.data() + begin[v], to.data() + begin[v + 1]};
  }
};

enum class Side : std::uint8_t { first, second, separator };

// The part of a graph in which a separator is sought. Vertices marked in `touches_first` have neighbours on
// the first side of the band. Vertices marked in `touches_second` have neighbours on the second side. The
// search takes linear time if the positions draw the graph without crossings and each vertex lists its
// neighbours counter-clockwise. Otherwise the search takes longer, but its result is the same.
struct SeparatorBand {
  Graph graph;
  std::vector<Eigen::Vector2f> positions;
  Eigen::Vector2f direction;  // from the first side to the second
  std::vector<std::uint8_t> touches_first, touches_second;
};

// Two separators with the smallest possible number of vertices: the one nearest to the first side, and the
// one nearest to the second. Each is given by a side per vertex of the band.
struct MinimumSeparators {
  std::vector<Side> near_first, near_second;
};

// Returns the minimum separators of the band. By Menger's theorem their size is the largest number of
// vertex-disjoint paths between the two sides. In the plane, repeatedly taking the uppermost remaining path
// finds nearly all of these paths. Augmenting paths (Dinic 1970) find the others.
MinimumSeparators minimum_separators(const SeparatorBand& band);

struct Bisection {
  std::vector<Side> side;                      // per vertex; no edge connects the first side with the second
  Index first = 0, second = 0, separator = 0;  // numbers of vertices
};

// Returns a bisection with few vertices in the separator and sides of similar size. The separator is sought in a
// straight band perpendicular to the direction in which the positions spread most. `positions`, one per vertex, only
// guide the search. If they are useless (coincident, or unrelated to the graph), distances in the graph replace them.
// A side may be empty if no better bisection is found.
Bisection bisect(const Graph& graph, std::span<const Eigen::Vector2f> positions);

// Returns the vertices in an elimination order that causes little fill. The order is computed recursively:
// separators come after both sides; small parts are ordered by minimum degree. `positions` (finite, one per
// vertex) only guide the search. Bad positions cause more fill, but never a wrong result. The search is
// faster if nearby vertices have similar indices. The result is the same for any number of threads.
std::vector<Index> dissection_order(const Graph& graph, std::span<const Eigen::Vector2f> positions);

}  // namespace relievo::solver
