// Represents quantities by their values at the nodes of a square lattice over the view plane. The quantities
// must change slowly from point to point.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/cubic_stencil.h"
#include "relievo/core/types.h"

namespace relievo {

// A lattice of square cells over given points. It extends beyond the points by at least one cell on each
// side. Values at its nodes are interpolated bilinearly within a cell. Nodes are numbered row by row; a cell
// has the number of its first node.
class Lattice {
 public:
  // One value per corner of a cell: the first node, and its neighbours in x, in y and in both.
  using Corners = std::array<float, 4>;

  // The range of the values in a cell; lowest > highest if the cell has no values.
  struct Extent {
    float lowest, highest;
  };

  // gather() and compare() use only points listed in `counted`; no point may be listed twice. At most 12
  // points per cell are used, evenly distributed in their order. `cell` > 0 is the width of a cell in the
  // unit of the points.
  Lattice(std::span<const Vec3> points, std::span<const Index> counted, double cell);

  std::size_t width() const { return width_; }
  std::size_t nodes() const { return share_.size(); }

  // Returns whether a counted point has a weight at the node.
  bool is_reached(std::size_t node) const { return share_[node] > 0; }

  std::size_t memory() const;

  // Values at 5 x 5 positions of a cell, including its edges.
  using Tile = std::array<float, 25>;

  // Evaluates a cubic B-spline with the coefficients `nodes` at the positions of each tile; there is one tile per
  // node. Unlike bilinear values, the spline has no creases between cells. Tiles of cells without points are not
  // written.
  void refine(std::span<const float> nodes, std::span<Tile> tiles) const;

  // Returns the value at any point, counted or not, by bilinear interpolation between the nearest four
  // positions of its tile.
  float at(std::size_t point, std::span<const Tile> tiles) const {
    const SplinePlace& p = places_[point];
    const float* t = tiles[p.node].data() + 5 * (p.y >> bits_in_quarter) + (p.x >> bits_in_quarter);
    const float x = share_of_quarter(p.x), y = share_of_quarter(p.y);
    const float below = t[0] + x * (t[1] - t[0]), above = t[5] + x * (t[6] - t[5]);
    return below + y * (above - below);
  }

  // Returns the position of a point in cells; node n is at (n % width(), n / width()).
  Vec2 place(std::size_t point) const;

  // Adds an amount to the 4 x 4 nodes around a position (in cells, see place()), weighted by cubic B-splines.
  // With these weights, sums over a region depend little on the positions of the nodes.
  void spread(const Vec2& place, float amount, std::span<float> nodes) const;

  // Sets marks[n] to 1 for each node n inside a triangle of points. The triangle must be counter-clockwise.
  // `marks` has an element per node.
  void mark_nodes_in(const Triangle& triangle, std::span<std::uint8_t> marks) const;

  // Sets marks[n] to 1 for the four nodes n around a point.
  void mark_nodes_around(std::size_t point, std::span<std::uint8_t> marks) const {
    const std::size_t n = cell_of(places_[point]);
    marks[n] = marks[n + 1] = marks[n + width_] = marks[n + width_ + 1] = 1;
  }

  // Writes to `means`, per node, the weighted mean of the values at the counted points around the node; 0 if there are
  // none. The weight of a point is the square of the node's bilinear weight at the point. `sums` is scratch memory.
  // `means` and `sums` have an element per node.
  template <typename Real>
  void gather(std::span<const Real> values, std::span<Corners> sums, std::span<float> means) const;

  // Writes for each cell the range of the differences between the values of its counted points and the values
  // that are interpolated from `nodes`.
  template <typename Real>
  void compare(std::span<const Real> values, std::span<const float> nodes, std::span<Extent> cells) const;

  // Calls f(cell, corner) for the cells around a node; the node is corner number `corner` of the cell.
  // Cells outside the lattice are left out or contain no points.
  template <typename F>
  void each_cell(std::size_t node, F&& f) const {
    f(node, 0);
    if (node >= 1) f(node - 1, 1);
    if (node >= width_) f(node - width_, 2);
    if (node > width_) f(node - width_ - 1, 3);
  }

 private:
  // A counted point with its position, stored by cell, because the points of a cell may be far apart in
  // memory.
  struct Counted {
    Index point;
    SplinePlace place;
  };

  // The two highest bits of a packed coordinate say in which of the four quarters of the cell's width the
  // position lies. The other bits give the position within this quarter.
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
  // Interpolates between the nodes of a cell; `n` is the first one.
  float between(const Corners& w, const float* n) const {
    return w[0] * n[0] + w[1] * n[1] + w[2] * n[width_] + w[3] * n[width_ + 1];
  }
  void set_places(std::span<const Vec3> points, double cell);
  void set_first_nodes();
  void count(std::span<const Index> counted);
  template <typename F>
  void for_cells(F&& f) const;

  std::size_t width_ = 0;
  std::vector<SplinePlace> places_;  // positions of all points
  std::vector<Index> first_nodes_;   // first of the 4 x 4 nodes around each cell with points
  std::vector<Counted> counted_;     // counted points, cell by cell
  std::vector<Index> begin_;         // per cell, where its points begin in counted_
  std::vector<float> share_;         // per node: 1 / the sum of the squared weights, 0 if that is 0
};

}  // namespace relievo
