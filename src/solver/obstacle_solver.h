// Solves an obstacle problem on a lattice: the smoothest field between two bounds, from coarse to fine.
#pragma once

#include <array>
#include <vector>

#include "relievo/core/types.h"

namespace relievo::solver {

// Strengths of the terms that pull the field b towards zero.
struct Springs {
  float stiffness = 0;           // factor of b^2 at each free node, >= 0
  float boundary_stiffness = 1;  // factor of the tension to neighbours that are fixed, (0, 1]
};

// The material, per node of a lattice, row by row.
struct Stiffness {
  std::vector<float> bending;  // factor of (lap b)^2, >= 0; a node where it is 0 is fixed at b = 0
  std::vector<float> tension;  // > 0, at fixed nodes, too; an edge has the mean of its two nodes
};

// Finds approximately the field b with lowest <= b <= highest that minimises
//   1/2 sum bending (lap b)^2 + 1/2 sum tension (b_i - b_j)^2 + 1/2 sum springs b^2 - sum wanted b,
// a thin plate under tension on springs, with `wanted` as its load. lap b is the sum of the four neighbours
// minus 4 b. Nodes on the lattice's rim must be fixed. Projected successive over-relaxation on lattices with
// cells of 8, 4, 2 and 1, each starting from the solution of the coarser one. Const calls may run
// concurrently, each with a workspace of its own.
class ObstacleSolver {
 public:
  static constexpr std::size_t levels = 4;

  // Data of one level, each vector with one element per node.
  struct Fields {
    std::vector<float> lowest, highest, wanted, b;
    std::vector<float> moment;  // bending times lap b

    std::size_t memory() const;
  };

  // One element per level, from fine to coarse.
  using Workspace = std::array<Fields, levels>;

  // The lattice has `width` nodes per row and as many rows as the stiffness has elements for.
  ObstacleSolver(std::size_t width, Stiffness stiffness);

  Workspace make_workspace() const;

  // Returns the bytes held, workspaces not counted.
  std::size_t memory() const;

  // Calls f(node) for every node that is not fixed, in an order that never changes.
  template <typename F>
  void each_free_node(F&& f) const {
    levels_[0].each_node(f);
  }

  // Writes the solution to b of workspace[0], given its lowest <= highest and wanted. The other levels are
  // overwritten. Values at fixed nodes do not matter, but b and moment there must be 0, as make_workspace()
  // leaves them.
  void solve(const Springs& springs, Workspace& workspace) const;

 private:
  class Level {
   public:
    Level() = default;
    Level(std::size_t width, Stiffness stiffness);

    std::size_t size() const { return diagonal_.size(); }
    std::size_t memory() const;
    Level coarser() const;
    bool is_free(std::size_t node) const { return stiffness_.bending[node] > 0; }
    template <typename F>
    void each_node(F&& f) const {
      for (const std::vector<Index>& colour : nodes_)
        for (const Index n : colour) f(n);
    }

    // Computes bounds and load from those of the next finer level. Bounds that cross are set to their mean.
    void restrict_from(const Level& finer, const Fields& from, Fields& to) const;
    // Interpolates b from the next coarser level, bilinearly.
    void prolong_from(const Level& coarser, const Fields& from, Fields& to) const;
    void relax(int times, const Springs& springs, Fields& f) const;

   private:
    void couple(std::size_t n);
    void start(Fields& f) const;
    void move(Index n, const Springs& springs, Fields& f) const;

    std::size_t width_ = 0;
    Stiffness stiffness_;
    // The free nodes in five colours. Nodes of one colour are so far apart that none changes what another
    // reads, so the processor can overlap their updates: 2.6 times as fast as row by row.
    std::array<std::vector<Index>, 5> nodes_;
    std::vector<float> fixed_;     // per node: tension to neighbours that are fixed
    std::vector<float> diagonal_;  // per node: of the energy's Hessian without springs
  };

  std::array<Level, levels> levels_;
};

}  // namespace relievo::solver
