// The graph of a sparse symmetric matrix.
#pragma once

#include <span>
#include <vector>

#include "relievo/core/types.h"

namespace relievo::solver {

// An undirected graph in compressed sparse rows: the neighbours of vertex v are to[begin[v]] up to, not
// including, to[begin[v + 1]]. Every edge is stored at both of its ends; no edge joins a vertex to itself.
// `begin` has one element more than there are vertices.
struct Graph {
  std::vector<Index> begin = {0};
  std::vector<Index> to;

  Index size() const { return static_cast<Index>(begin.size() - 1); }
  std::span<const Index> neighbours(Index v) const {
    return {to.data() + begin[v], to.data() + begin[v + 1]};
  }
};

}  // namespace relievo::solver
