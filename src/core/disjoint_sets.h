// Implements disjoint sets of the integers 0 to n - 1 (union-find), with union by size and path halving.
#pragma once

#include <numeric>
#include <utility>
#include <vector>

#include "relievo/core/types.h"

namespace relievo {

class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n) : parent_(n), size_(n, 1) {
    std::iota(parent_.begin(), parent_.end(), Index{0});
  }

  // Returns the representative of the set that contains i.
  Index find(Index i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  void join(Index a, Index b) {
    a = find(a), b = find(b);
    if (a == b) return;
    if (size_[a] < size_[b]) std::swap(a, b);
    parent_[b] = a;
    size_[a] += size_[b];
  }

  std::size_t size_of(Index i) { return size_[find(i)]; }

 private:
  std::vector<Index> parent_;
  std::vector<Index> size_;
};

}  // namespace relievo
