// Symbolic factorisation: finds the supernodes of a sparse Cholesky factor and the rows of each. Tested by
// tests/solver/cholesky_test.cpp.
#pragma once

#include "solver/dissection.h"

namespace relievo::solver {

// The columns in elimination order, grouped into supernodes: consecutive columns that are stored as one dense panel.
// The rows of a panel are the supernode's columns and the rows in `rows`. Supernodes are in postorder of the assembly
// tree.
struct Supernodes {
  std::vector<Index> order;        // per column: the vertex that is eliminated there
  std::vector<Index> first = {0};  // supernode s has the columns first[s] up to first[s + 1]
  std::vector<Index> parent;       // supernode that contains the first row below; no_index for a root
  // The rows of supernode s below its own columns, as ascending column indices, are in rows[i] for
  // begin[s] <= i < begin[s + 1].
  std::vector<std::size_t> begin = {0};
  std::vector<Index> rows;

  Index size() const { return static_cast<Index>(parent.size()); }
  Index width(Index s) const { return first[s + 1] - first[s]; }
  Index below(Index s) const { return static_cast<Index>(begin[s + 1] - begin[s]); }
  std::span<const Index> rows_of(Index s) const {
    return {rows.data() + begin[s], rows.data() + begin[s + 1]};
  }
};

// Returns the supernodes for eliminating `graph` in the given order, or in an order with the same fill.
// Consecutive columns with the same structure form a supernode. Supernodes are merged if that makes a
// substitution cheaper, although the merged panel then contains some zeros.
Supernodes analyse(const Graph& graph, std::span<const Index> order);

// Returns the number of floats of a supernode's panel with `width` columns and `below` rows under them, see
// supernode_panel.h.
std::size_t panel_floats(Index width, Index below);

}  // namespace relievo::solver
