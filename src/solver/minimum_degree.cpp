#include "solver/minimum_degree.h"

#include <algorithm>
#include <bit>

namespace relievo::solver {

void MinimumDegree::order(std::span<Index> piece) {
  gather(piece);
  std::vector<Index> sequence;
  sequence.reserve(piece.size());
  for (std::size_t step = 0; step < piece.size(); ++step) {
    const auto least = std::min_element(degree_.begin(), degree_.end());
    const auto v = static_cast<Index>(least - degree_.begin());
    sequence.push_back(piece[v]);
    eliminate(v);
  }
  for (const Index v : piece) slots_[v] = no_index;
  std::copy(sequence.begin(), sequence.end(), piece.begin());
}

void MinimumDegree::gather(std::span<const Index> piece) {
  const auto n = static_cast<Index>(piece.size());
  for (Index i = 0; i < n; ++i) slots_[piece[i]] = i;
  outside_.clear();
  for (const Index v : piece)
    for (const Index u : graph_.neighbours(v))
      if (slots_[u] == no_index) outside_.push_back(u);
  std::sort(outside_.begin(), outside_.end());
  outside_.erase(std::unique(outside_.begin(), outside_.end()), outside_.end());

  words_ = (n + outside_.size() + 63) / 64;
  sets_.assign(n * words_, 0);
  degree_.resize(n);
  for (Index i = 0; i < n; ++i) {
    for (const Index u : graph_.neighbours(piece[i])) {
      const Index slot = slots_[u] != no_index ? slots_[u] : n + slot_outside(u);
      set(i)[slot / 64] |= std::uint64_t{1} << slot % 64;
    }
    degree_[i] = static_cast<Index>(graph_.neighbours(piece[i]).size());
  }
}

Index MinimumDegree::slot_outside(Index vertex) {
  return static_cast<Index>(std::lower_bound(outside_.begin(), outside_.end(), vertex) - outside_.begin());
}

// Makes the neighbours of v neighbours of each other, which is the fill that eliminating v causes. Only
// vertices of the piece have sets, so the loop ends at the first neighbour outside it.
void MinimumDegree::eliminate(Index v) {
  degree_[v] = no_index;
  const std::uint64_t* eliminated = set(v);
  for (std::size_t w = 0; w < words_; ++w) {
    for (std::uint64_t bits = eliminated[w]; bits != 0; bits &= bits - 1) {
      const auto u = static_cast<Index>(64 * w) + static_cast<Index>(std::countr_zero(bits));
      if (u >= degree_.size()) return;
      std::uint64_t* to = set(u);
      Index degree = 0;
      for (std::size_t i = 0; i < words_; ++i) {
        to[i] |= eliminated[i];
        if (i == v / 64) to[i] &= ~(std::uint64_t{1} << v % 64);
        if (i == u / 64) to[i] &= ~(std::uint64_t{1} << u % 64);
        degree += static_cast<Index>(std::popcount(to[i]));
      }
      degree_[u] = degree;
    }
  }
}

}  // namespace relievo::solver
