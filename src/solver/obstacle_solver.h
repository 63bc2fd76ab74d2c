// Solves an obstacle problem on a lattice: finds the smoothest field between two bounds, from coarse to fine.
#pragma once

#include <array>
#include <limits>
#include <span>
#include <vector>

#include "relievo/core/types.h"
#include "solver/order_pull.h"

namespace relievo::solver {

// Strengths of the terms that pull the field b: at ties towards zero, and back up to a least value, see Tie
// below; and between pairs of nodes, see OrderedPairs.
struct Springs {
  float tie_stiffness = 1;  // factor of the ties, >= 0
  // A tie pulls b back to this value if b is lower there.
  float least_at_ties = -std::numeric_limits<float>::infinity();
  float stop_stiffness = 10;  // factor of that pull, >= 0
  OrderLimits order = {};
};

// Ties the field to zero at a place within a cell, for curves that pass between the nodes.
struct Tie {
  std::size_t cell;  // the number of the cell's first node
  Vec2f at;          // within the cell, in [0, 1]
  float stiffness;   // factor of the square of the value that is interpolated bilinearly there, > 0
};

// The stiffness of the material: one element per node of a lattice, row by row.
struct Stiffness {
  std::vector<float> bending;  // factor of (lap b)^2, >= 0; a node where it is 0 is fixed at b = 0
  std::vector<float> tension;  // > 0, at fixed nodes, too; an edge has the mean of its two nodes
};

// Finds approximately the field b with lowest <= b <= highest that minimises
//   1/2 sum bending (lap b)^2 + 1/2 sum tension (b_i - b_j)^2 + 1/2 sum hold b^2 - sum load b
//   + 1/2 sum ties (tie_stiffness b^2 + stop_stiffness min(b - least_at_ties, 0)^2),
// a thin plate under tension on springs, with a load, tied down at places between its nodes. With pairs, hold
// and load are those of OrderPull for the present b, again and again.
// lap b is the sum of the four neighbours minus 4 b. Nodes on the lattice's rim must be fixed. The method is
// projected successive over-relaxation on lattices with cells of 8, 4, 2 and 1, each starting from the
// solution of the coarser one. Const calls may run concurrently, each with a workspace of its own.
class ObstacleSolver {
 public:
  static constexpr std::size_t levels = 4;

  // Data of one level. Each vector except at_ties has one element per node.
  struct Fields {
    std::vector<float> lowest, highest, load, hold, b;
    std::vector<float> heights, lack;  // for the pairs: the heights to which b is added, and scratch memory
    std::vector<float> moment;         // bending times lap b
    std::vector<float> at_ties;        // per tie, b at the tie; then a 0 per tied node, see TiedNode

    std::size_t memory() const;
  };

  // One element per level, from fine to coarse.
  using Workspace = std::array<Fields, levels>;

  // The lattice has `width` nodes per row and as many rows as the stiffness has elements for. A cell has at
  // most one tie. Of the pairs, `depth` has an element per node, or none if there are no pairs.
  ObstacleSolver(std::size_t width, Stiffness stiffness, std::span<const Tie> ties = {},
                 const OrderedPairs& pairs = {});

  Workspace make_workspace() const;

  // Returns the bytes of memory in use, workspaces not counted.
  std::size_t memory() const;

  // Calls f(node) for every node that is not fixed, in an order that never changes.
  template <typename F>
  void each_free_node(F&& f) const {
    levels_[0].each_node(f);
  }

  // Writes the solution to b of workspace[0], given lowest <= highest there and, with pairs, the heights, else
  // load and hold. The other levels are overwritten. Values at fixed nodes do not matter, but b and moment there
  // must be 0, as make_workspace() leaves them.
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

    // Computes bounds and load from those of the next finer level. Bounds that cross are set to their mean.
    void restrict_from(const Level& finer, const Fields& from, Fields& to) const;
    // Interpolates b from the next coarser level, bilinearly.
    void prolong_from(const Level& coarser, const Fields& from, Fields& to) const;
    // Between updates of the pull of the pairs are `every` sweeps.
    void relax(int times, int every, const Springs& springs, Fields& f) const;
    void set_order(const OrderedPairs& pairs) { order_ = OrderPull(width_, pairs); }
    // Returns the values at the nodes that the next coarser level keeps.
    std::vector<float> kept_by(const Level& coarser, std::span<const float> values) const;

   private:
    struct Slope {
      float first = 0, second = 0;  // first and second derivative of the energy by the value of a node
    };
    // A node's part in a tie: the value at the tie is the sum of weight times b over the four nodes of its
    // cell.
    struct Share {
      Index tie;
      float weight = 0, stiffness = 0;  // weight of the node; stiffness of the tie times this weight
    };
    struct TiedNode {
      Index node;
      // For a cell without a tie the share has weight 0, and its `tie` is the index of a dummy value in
      // at_ties that only this node uses. With one dummy for all nodes, each update would have to wait for
      // the write of the update before.
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
    // The free nodes in five colours. Nodes of one colour are so far apart that none changes what another
    // reads, so the processor can overlap their updates: 2.6 times as fast as row by row.
    std::array<Colour, 5> colours_;
    OrderPull order_;
    std::vector<float> diagonal_;  // per node: diagonal of the energy's Hessian without springs
  };

  std::array<Level, levels> levels_;
};

}  // namespace relievo::solver
