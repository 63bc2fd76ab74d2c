// Solves an obstacle problem on a lattice, from coarse to fine: finds the smoothest field between two bounds.
#pragma once

#include <array>
#include <limits>
#include <span>
#include <vector>

#include "relievo/core/types.h"
#include "solver/order_pull.h"

namespace relievo::solver {

// Strengths of the forces on the field b. A tie pulls b towards zero. Where b is below `least_at_ties`, the tie also
// pulls b up to this value. `order` has the strengths of the forces between pairs of nodes.
struct Springs {
  float tie_stiffness = 1;  // factor of the ties, >= 0
  // If b is below this value at a tie, a second force pulls it upwards.
  float least_at_ties = -std::numeric_limits<float>::infinity();
  float stop_stiffness = 10;  // factor of the force towards least_at_ties, >= 0
  OrderLimits order = {};
};

// Pulls the field to zero at a position within a cell. Ties represent curves that run between the nodes.
struct Tie {
  std::size_t cell;  // number of the cell's first node
  Vec2f at;          // position within the cell, in [0, 1]
  float stiffness;   // > 0; factor of the square of the bilinearly interpolated value
};

// The stiffness of the material, per node of the lattice, row by row.
struct Stiffness {
  std::vector<float> bending;  // factor of (lap b)^2, >= 0; if 0, the node is fixed at b = 0
  std::vector<float> tension;  // > 0, also at fixed nodes; an edge has the mean tension of its two nodes
};

// Approximates the field b with lowest <= b <= highest that minimises
//   1/2 sum bending (lap b)^2 + 1/2 sum tension (b_i - b_j)^2 + 1/2 sum hold b^2 - sum load b
//   + 1/2 sum ties (tie_stiffness b^2 + stop_stiffness min(b - least_at_ties, 0)^2),
// where lap b is the sum of the four neighbours minus 4 b. This is a thin plate under tension with a load,
// with springs (`hold`) at the nodes, and with ties at positions within cells. If the constructor gets pairs
// of nodes, OrderPull repeatedly computes hold and load from the current b. Nodes on the lattice's rim must
// be fixed.
//
// The method is projected successive over-relaxation on four lattices. Their cells are 8, 4, 2 and 1 times as
// wide as the cells of the given lattice. Each lattice starts from the solution of the coarser one. Const
// calls may run concurrently if each has its own workspace.
class ObstacleSolver {
 public:
  static constexpr std::size_t levels = 4;

  // Data of one level. Each vector except at_ties has an element per node.
  struct Fields {
    std::vector<float> lowest, highest, load, hold, b;
    std::vector<float> heights, lack;  // used for pairs only: the heights without b, and scratch memory
    std::vector<float> moment;         // bending times lap b
    std::vector<float> at_ties;        // per tie: the value of b there; then a 0 per tied node, see TiedNode

    std::size_t memory() const;
  };

  // One element per level, from fine to coarse.
  using Workspace = std::array<Fields, levels>;

  // The lattice has `width` nodes per row; the number of elements of `stiffness` determines the number of
  // rows. A cell has at most one tie. `pairs.depth` has an element per node, or none if there are no pairs.
  ObstacleSolver(std::size_t width, Stiffness stiffness, std::span<const Tie> ties = {},
                 const OrderedPairs& pairs = {});

  Workspace make_workspace() const;

  // Returns the bytes of memory in use, without workspaces.
  std::size_t memory() const;

  // Calls f(node) for every node that is not fixed, always in the same order.
  template <typename F>
  void each_free_node(F&& f) const {
    levels_[0].each_node(f);
  }

  // Writes the solution to b of workspace[0]. Reads the bounds from workspace[0]; `lowest` must be at most
  // `highest`. If there are pairs, also reads the heights from workspace[0]; if there are none, reads load
  // and hold instead. Overwrites the other levels. Values at fixed nodes are ignored, except that b and
  // moment must be 0 there, as make_workspace() leaves them.
  void solve(const Springs& springs, Workspace& workspace) const;

 private:
  class Level {
   public:
    Level() = default;
    Level(std::size_t width, Stiffness stiffness, std::vector<Tie> ties);

    std::size_t size() const { return diagonal_.size(); }
    std::size_t tie_values() const { return ties_.size() + tied_nodes_; }
    std::size_t memory() const;
    Level coarser() const;
    bool is_free(std::size_t node) const { return stiffness_.bending[node] > 0; }
    template <typename F>
    void each_node(F&& f) const {
      for (const Colour& colour : colours_) {
        for (const Index n : colour.untied) f(n);
        for (const TiedNode& tied : colour.tied) f(tied.node);
      }
    }

    // Computes bounds, load, hold and heights from those of the next finer level. If a node's lower bound exceeds its
    // upper bound, both are set to their mean.
    void restrict_from(const Level& finer, const Fields& from, Fields& to) const;
    // Interpolates b from the next coarser level, bilinearly.
    void prolong_from(const Level& coarser, const Fields& from, Fields& to) const;
    // Makes `times` sweeps. The forces of the pairs are updated after every `every` sweeps.
    void relax(int times, int every, const Springs& springs, Fields& f) const;
    void set_order(const OrderedPairs& pairs) { order_ = OrderPull(width_, pairs); }
    // Returns the values at the nodes that the next coarser level keeps.
    std::vector<float> kept_by(const Level& coarser, std::span<const float> values) const;

   private:
    struct Slope {
      // First and second derivative of the energy with respect to a node's value.
      float first = 0, second = 0;
    };
    // A node's part in a tie. The value at a tie is the sum of weight * b over the four nodes of its cell.
    struct Share {
      Index tie;
      float weight = 0, stiffness = 0;  // weight of the node; stiffness of the tie times this weight
    };
    struct TiedNode {
      Index node;
      // The node's parts in the ties of the four cells around it. If a cell has no tie, the weight is 0, and
      // `tie` is the index of an unused value in at_ties that belongs to this node alone. If nodes shared
      // that value, each update would have to wait for the write of the previous one.
      std::array<Share, 4> shares;
    };
    struct Colour {
      std::vector<Index> untied;
      std::vector<TiedNode> tied;
    };

    void couple(std::size_t n, std::span<const Index> tie_of);
    std::vector<Tie> coarser_ties(std::size_t width) const;
    void start(Fields& f) const;
    float move(Index n, const Slope& ties, Fields& f) const;
    void move_tied(const TiedNode& tied, const Springs& springs, Fields& f) const;

    std::size_t width_ = 0;
    Stiffness stiffness_;
    std::vector<Tie> ties_;
    std::size_t tied_nodes_ = 0;
    // The free nodes, divided into five colours. No update reads a value that another update of the same colour
    // changes. So the processor can overlap the updates of a colour, which is 2.6 times as fast as updating row by
    // row.
    std::array<Colour, 5> colours_;
    OrderPull order_;
    std::vector<float> diagonal_;  // per node: diagonal of the energy's Hessian without springs
  };

  std::array<Level, levels> levels_;
};

}  // namespace relievo::solver
