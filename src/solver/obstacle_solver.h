// The smoothest sheet between limits: an obstacle problem on a lattice, solved from coarse to fine.
#pragma once

#include <array>
#include <vector>

#include "relievo/core/types.h"

namespace relievo {

// What draws a sheet b to 0.
struct Ties {
  float pull = 0;    // of b^2, >= 0
  float anchor = 1;  // of the tension to neighbours that are fixed, (0, 1]
};

// What resists, per node of a lattice, row by row.
struct Stiffness {
  std::vector<float> bending;  // to second differences; where it is 0 b is fixed at 0
  std::vector<float> tension;  // > 0, at fixed nodes, too; to the difference of two neighbours: their mean
};

// Of all b with lowest <= b <= highest on a lattice, one near the least energy: half of the sum of bending
// (lap b)^2, tension times squared differences between neighbours and ties, less that of wanted b. lap b is
// the sum of the four neighbours less 4 b. Nodes on the lattice's rim have to be fixed.
// Successive over-relaxation on lattices of 8, 4, 2 and 1 cells, each starting from what the coarser one
// found. Const calls may run concurrently, each with a workspace of its own.
class ElasticSheet {
 public:
  static constexpr std::size_t levels = 4;

  // Per node of a level.
  struct Fields {
    std::vector<float> lowest, highest, wanted, b;
    std::vector<float> moment;  // bending times the second differences of b

    std::size_t memory() const;
  };

  // From fine to coarse.
  using Workspace = std::array<Fields, levels>;

  // `width` nodes make a row.
  ElasticSheet(std::size_t width, Stiffness stiffness);

  Workspace make_workspace() const;

  // Bytes held, workspaces not counted.
  std::size_t memory() const;

  // Calls f(node) for every node that is not fixed, in an order that never changes.
  template <typename F>
  void each_free_node(F&& f) const {
    levels_[0].each_node(f);
  }

  // Finds the finest b for the finest limits, lowest <= highest, and what is wanted; of fixed nodes they do
  // not matter, but b and moment there have to be 0, as make_workspace() leaves them.
  void solve(const Ties& ties, Workspace& workspace) const;

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

    // Limits and what is wanted from the next finer level's. Limits that cross meet in the middle.
    void restrict_from(const Level& finer, const Fields& from, Fields& to) const;
    // b from the next coarser level's.
    void prolong_from(const Level& coarser, const Fields& from, Fields& to) const;
    void relax(int times, const Ties& ties, Fields& f) const;

   private:
    void couple(std::size_t n);
    void start(Fields& f) const;
    void move(Index n, const Ties& ties, Fields& f) const;

    std::size_t width_ = 0;
    Stiffness stiffness_;
    // A colour's nodes are so far apart that none moves what another reads, so that the processor need not
    // wait for one before the next: 2.6 times as fast as row by row.
    std::array<std::vector<Index>, 5> nodes_;
    std::vector<float> fixed_;     // per node: tension to neighbours that are fixed
    std::vector<float> diagonal_;  // per node: of the energy's matrix without ties
  };

  std::array<Level, levels> levels_;
};

}  // namespace relievo
