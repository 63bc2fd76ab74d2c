// Computes forces between nodes of a lattice that raise near parts above farther ones.
#pragma once

#include <span>
#include <vector>

#include "relievo/core/types.h"

namespace relievo::solver {

// Pairs of nodes at the distances `distances`, in cells, along rows, columns and both diagonals. The nearer
// node of a pair should be higher by the product of OrderLimits::height, tanh(|difference of depth| /
// saturation), and the shares of both nodes.
struct OrderedPairs {
  std::span<const float> depth;  // per node, larger is nearer
  std::span<const float> share;  // per node, in [0, 1]; nodes with share 0 are in no pair
  float saturation = 1;          // > 0
  std::vector<float> distances;  // > 0; distances below half a cell are left out
};

struct OrderLimits {
  float height = 0;     // largest height by which one node of a pair should be above the other, >= 0
  float stiffness = 0;  // stiffness of the forces, >= 0
};

// An energy that is small if nearer nodes are higher: 1/2 stiffness times the sum over all pairs of (missing height
// difference)^2. It is convex, and 0 if the order is right. write_bound() replaces it by a quadratic upper bound,
// with which relaxation converges although all nodes move at the same time.
class OrderPull {
 public:
  OrderPull() = default;
  OrderPull(std::size_t width, const OrderedPairs& pairs);

  bool empty() const { return directions_.empty(); }
  std::size_t memory() const;

  // Writes `hold` and `load` so that for some constant c, c + 1/2 sum(hold x^2) - sum(load x) is an upper
  // bound of the energy of a field x. At x = b the bound equals the energy. `heights` are the heights without
  // the field; `lack` is scratch memory. All spans have an element per node.
  struct Bound {
    std::span<float> load, hold, lack;
  };
  void write_bound(std::span<const float> b, std::span<const float> heights, const OrderLimits& limits,
                   const Bound& bound) const;

 private:
  struct Direction {
    std::size_t offset;  // > 0; index of a pair's second node minus index of its first
    // Per node: if it is the first node of a pair, its wanted height above the second node, as a share of
    // OrderLimits::height; otherwise 0.
    std::vector<float> wanted;
  };
  std::vector<Direction> directions_;
};

}  // namespace relievo::solver
