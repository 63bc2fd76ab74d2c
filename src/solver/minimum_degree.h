// Minimum-degree ordering of small pieces of a graph. Tested by tests/solver/dissection_test.cpp.
#pragma once

#include <cstdint>

#include "solver/graph.h"

namespace relievo::solver {

// Orders pieces of one graph. The object keeps its storage: use one for many pieces.
class MinimumDegree {
 public:
  // Both arguments must outlive the object. `slots` has one element per vertex of the graph, all no_index,
  // and is left so. Objects may share it and order pieces concurrently if no edge joins these pieces.
  MinimumDegree(const Graph& graph, std::span<Index> slots) : graph_(graph), slots_(slots) {}

  // Permutes the vertices of `piece` so that eliminating them in that order, before all others, causes little
  // fill: the next vertex is always one with the fewest remaining neighbours, those outside the piece
  // included. The degrees are exact, kept with bit sets, so that time and memory grow at least with the
  // square of the size; it is meant for pieces of up to a few hundred vertices.
  void order(std::span<Index> piece);

 private:
  void gather(std::span<const Index> piece);
  void eliminate(Index v);
  Index slot_outside(Index vertex);
  std::uint64_t* set(Index slot) { return sets_.data() + slot * words_; }

  const Graph& graph_;
  std::span<Index> slots_;
  std::vector<Index> outside_;  // vertices adjacent to the piece, ascending
  std::vector<std::uint64_t>
      sets_;                   // per vertex of the piece, its neighbours: first the piece, then outside_
  std::vector<Index> degree_;  // no_index once eliminated
  std::size_t words_ = 0;
};

}  // namespace relievo::solver
