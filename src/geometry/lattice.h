// A square lattice over the view plane, for what changes slowly from point to point.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/cubic_stencil.h"
#include "relievo/core/types.h"

namespace relievo {

// Fixed points on a lattice that surrounds them by at least one cell. Between its four nodes a value is
// bilinear. Nodes are numbered row by row.
class Lattice {
 public:
  // The corners of a cell: the first, and those next to it in x, in y and in both.
  using Corners = std::array<float, 4>;

  // Of values in a cell; none if lowest > highest.
  struct Extent {
    float lowest, highest;
  };

  // `counted` are the points, each once, that nodes and cells know: of a cell at most 12, spread evenly over
  // their order. `cell` > 0 is in units of the points.
  Lattice(std::span<const Vec3> points, std::span<const Index> counted, double cell);

  std::size_t width() const { return width_; }
  std::size_t nodes() const { return share_.size(); }

  // Whether a counted point has a weight at the node.
  bool is_reached(std::size_t node) const { return share_[node] > 0; }

  // Bytes held.
  std::size_t memory() const;

  // Values at 5 x 5 places of a cell, its rim included.
  using Tile = std::array<float, 25>;

  // Writes to the tiles, one per node, what cubic B-splines, which have no creases between cells, make of the
  // nodes: weighted means of the 4 x 4 around a place. Of cells without points they are left as they are.
  void refine(std::span<const float> nodes, std::span<Tile> tiles) const;

  // The value at a point, counted or not, of nodes that have been refined: bilinear in quarters of a cell.
  float at(std::size_t point, std::span<const Tile> tiles) const {
    const SplinePlace& p = places_[point];
    const float* t = tiles[p.node].data() + 5 * (p.y >> bits_in_quarter) + (p.x >> bits_in_quarter);
    const float x = share_of_quarter(p.x), y = share_of_quarter(p.y);
    const float below = t[0] + x * (t[1] - t[0]), above = t[5] + x * (t[6] - t[5]);
    return below + y * (above - below);
  }

  // Sets to 1 what belongs to the nodes in a triangle of points, which runs counter-clockwise; one entry per
  // node.
  void mark_nodes_in(const Triangle& triangle, std::span<std::uint8_t> marks) const;

  // Sets to 1 what belongs to the four nodes around a point.
  void mark_nodes_around(std::size_t point, std::span<std::uint8_t> marks) const {
    const std::size_t n = cell_of(places_[point]);
    marks[n] = marks[n + 1] = marks[n + width_] = marks[n + width_ + 1] = 1;
  }

  // Writes to each node the mean of the counted points around it, by the squares of the weights that the node
  // has at them; 0 where there are none. `sums` is scratch; it and `means` have an entry per node.
  template <typename Real>
  void gather(std::span<const Real> values, std::span<Corners> sums, std::span<float> means) const;

  // Writes per cell, which has the number of its first node, the lowest and the highest of its counted values
  // less the bilinear ones between its nodes.
  template <typename Real>
  void compare(std::span<const Real> values, std::span<const float> nodes, std::span<Extent> cells) const;

  // Calls f(cell, corner) for the four cells around a node; corner is the node's in that cell. Cells beyond
  // the rim are left out or hold no points.
  template <typename F>
  void each_cell(std::size_t node, F&& f) const {
    f(node, 0);
    if (node >= 1) f(node - 1, 1);
    if (node >= width_) f(node - width_, 2);
    if (node > width_) f(node - width_ - 1, 3);
  }

 private:
  // A point of a cell, with its place: neighbours in memory, where points of a cell need not be.
  struct Counted {
    Index point;
    SplinePlace place;
  };

  // A share's two first bits are the quarter, the others the share of it.
  static constexpr int bits_in_quarter = 14;
  static float share_of_quarter(std::uint16_t share) {
    constexpr int whole = 1 << bits_in_quarter;
    return static_cast<float>(share & (whole - 1)) / whole;
  }

  std::size_t cell_of(const SplinePlace& p) const { return p.node + width_ + 1; }
  static Corners weights(const SplinePlace& p) {
    const float x = unpacked_share(p.x), y = unpacked_share(p.y);
    return {(1 - x) * (1 - y), x * (1 - y), (1 - x) * y, x * y};
  }
  // `n` is the cell's first node.
  float between(const Corners& w, const float* n) const {
    return w[0] * n[0] + w[1] * n[1] + w[2] * n[width_] + w[3] * n[width_ + 1];
  }
  Vec2 place(std::size_t point) const;
  void set_places(std::span<const Vec3> points, double cell);
  void set_first_nodes();
  void count(std::span<const Index> counted);
  template <typename F>
  void for_cells(F&& f) const;

  std::size_t width_ = 0;
  std::vector<SplinePlace> places_;  // of all points
  std::vector<Index> first_nodes_;   // of the 4 x 4 around cells with points, each once
  std::vector<Counted> counted_;     // by cell
  std::vector<Index> begin_;         // of the points of a cell in counted_
  std::vector<float> share_;         // per node: 1 / the sum of the squared weights, 0 if that is 0
};

}  // namespace relievo
