// Pulls on the differences between nodes of a lattice, so that near parts stand before far ones.
#pragma once

#include <span>
#include <vector>

#include "relievo/core/types.h"

namespace relievo::solver {

// The pairs of nodes that lie `distances` apart, in cells, along rows, columns and both diagonals. Of each
// pair the node with the larger depth should be higher by tanh(|difference of depth| / saturation), times the
// shares of both nodes and OrderLimits::height.
struct OrderedPairs {
  std::span<const float> depth;  // per node, larger is nearer
  std::span<const float> share;  // per node, [0, 1]; nodes where it is 0 are in no pair
  float saturation = 1;          // > 0
  std::vector<float> distances;  // > 0; pairs that are less than half a cell apart are left out
};

struct OrderLimits {
  float height = 0;     // the most by which one node of a pair should be higher than the other, >= 0
  float stiffness = 0;  // of the pull, >= 0
};

// The energy of the pull is 1/2 stiffness times the sum over all pairs of the square of what their difference
// of heights lacks. It is convex, and 0 where the order is right. write_bound() replaces it by a quadratic
// bound, so that relaxation converges though all nodes move at once.
class OrderPull {
 public:
  OrderPull() = default;
  OrderPull(std::size_t width, const OrderedPairs& pairs);

  bool empty() const { return directions_.empty(); }
  std::size_t memory() const;

  // Writes the bound 1/2 sum hold b^2 - sum load b of the energy, up to a constant, that touches it at b.
  // `heights` are the heights without b; `lack` is scratch memory. All spans have an element per node.
  struct Bound {
    std::span<float> load, hold, lack;
  };
  void write_bound(std::span<const float> b, std::span<const float> heights, const OrderLimits& limits,
                   const Bound& bound) const;

 private:
  struct Direction {
    std::size_t offset;         // from the first node of a pair to the second, > 0
    std::vector<float> wanted;  // per first node: the signed share of the height; 0 if it is in no pair
  };
  std::vector<Direction> directions_;
};

}  // namespace relievo::solver
