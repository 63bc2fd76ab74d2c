// Minimum degree for small pieces of a graph.
#pragma once

#include <cstdint>

#include "solver/graph.h"

namespace relievo {

// Orders pieces of one graph. The object keeps its storage: use one for many pieces.
class LeafOrder {
 public:
  // Both must outlive the object. `slots` has one no_index per vertex; pieces that do not touch each other
  // may be ordered concurrently with the same one.
  LeafOrder(const Graph& graph, std::span<Index> slots) : graph_(graph), slots_(slots) {}

  // Permutes the vertices of `piece` so that eliminating them in that order, before all others, fills little:
  // always one with the fewest neighbours left, those outside the piece included. Exact, with sets of bits:
  // meant for pieces of up to a few hundred vertices.
  void order(std::span<Index> piece);

 private:
  void gather(std::span<const Index> piece);
  void eliminate(Index v);
  Index slot_outside(Index vertex);
  std::uint64_t* set(Index slot) { return sets_.data() + slot * words_; }

  const Graph& graph_;
  std::span<Index> slots_;
  std::vector<Index> outside_;       // vertices around the piece
  std::vector<std::uint64_t> sets_;  // per vertex of the piece, its neighbours: piece first, then outside
  std::vector<Index> degree_;        // no_index once eliminated
  std::size_t words_ = 0;
};

}  // namespace relievo
