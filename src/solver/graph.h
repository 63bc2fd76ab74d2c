// The graph of a sparse symmetric matrix.
#pragma once

#include <span>
#include <vector>

#include "relievo/core/types.h"

namespace relievo {

// Vertex v has the neighbours to[begin[v]] up to to[begin[v + 1]]; every edge stands at both of its ends,
// none joins a vertex to itself. `begin` has one element more than there are vertices.
struct Graph {
  std::vector<Index> begin = {0};
  std::vector<Index> to;

  Index size() const { return static_cast<Index>(begin.size() - 1); }
  std::span<const Index> neighbours(Index v) const {
    return {to.data() + begin[v], to.data() + begin[v + 1]};
  }
};

}  // namespace relievo
