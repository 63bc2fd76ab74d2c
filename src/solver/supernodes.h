// The structure of a sparse Cholesky factor: which columns are kept together, and which rows they fill.
#pragma once

#include "solver/graph.h"

namespace relievo {

// Columns in the order of elimination, in supernodes: consecutive columns stored as one dense trapezoid, its
// rows being the columns themselves and those of `rows`. Supernodes stand in postorder of the assembly tree.
struct Supernodes {
  std::vector<Index> order;        // vertex that is eliminated in this place
  std::vector<Index> first = {0};  // supernode s has the columns first[s] up to first[s + 1]
  std::vector<Index> parent;       // supernode of the first row below; no_index for a root
  std::vector<std::size_t> begin = {
      0};                   // rows of s below its columns: rows[begin[s]] up to rows[begin[s + 1]]
  std::vector<Index> rows;  // as places in the order, ascending

  Index size() const { return static_cast<Index>(parent.size()); }
  Index width(Index s) const { return first[s + 1] - first[s]; }
  Index below(Index s) const { return static_cast<Index>(begin[s + 1] - begin[s]); }
  std::span<const Index> rows_of(Index s) const {
    return {rows.data() + begin[s], rows.data() + begin[s + 1]};
  }
};

// Analyses the elimination of `graph` in about that order (equivalent ones may be chosen). Columns whose
// structures are alike become supernodes; so do others, with zeros stored, where that makes a substitution
// cheaper.
Supernodes analyse(const Graph& graph, std::span<const Index> order);

// Number of floats that a supernode's trapezoid takes, see trapezoid.h.
std::size_t trapezoid_floats(Index width, Index below);

}  // namespace relievo
