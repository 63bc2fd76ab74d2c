// Defines a sparse matrix of 2-vectors over points and their neighbours. A frame needs two products with it:
// the right-hand side of equation (9), and vertex normals (stage 13).
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "core/groups.h"
#include "relievo/core/types.h"
#include "relievo/geometry/triangulation.h"
#include "relievo/scan/boundary.h"

namespace relievo {

// An entry in the row of a point; `other` is the column.
struct MatrixEntry {
  Index other = 0;
  Vec2f coefficient = Vec2f::Zero();
};

// A sparse matrix, stored in slices of eight rows, so that vector instructions can read it. A slice has the
// first entry of all eight rows, then the second entry of all rows, and so on. To reduce padding, rows of
// similar length within windows of 256 points share a slice (SELL-C-sigma; Kreutzer, Hager, Wellein, Fehske
// and Bishop, 2014). Sums are computed in the order in which the entries are given.
class SlicedEllMatrix {
 public:
  // Copies the entries. `rows` has one group of entries per point.
  explicit SlicedEllMatrix(const Groups<MatrixEntry>& rows);

  // Copies the entries. If the sparsity pattern of `like` contains all these entries in order, that pattern
  // is reused, and its unused slots get coefficient 0.
  SlicedEllMatrix(const Groups<MatrixEntry>& rows, const SlicedEllMatrix& like);

  // Returns the number of points.
  std::size_t size() const { return pattern_->size; }

  // Returns the bytes of memory in use. A sparsity pattern that was reused from another matrix (see the
  // constructor) is not counted.
  std::size_t memory() const;

  // Writes sums[i] = sum of (slopes[i] + slopes[other]) . coefficient, over the entries of row i: the
  // right-hand side of equation (9).
  void divergence(std::span<const Vec2f> slopes, std::span<float> sums) const;
  void divergence(std::span<const Vec2> slopes, std::span<double> sums) const;

  // Writes a unit normal per point, along (x, y, 1), where (x, y) = sum of heights[other] *
  // coefficient over the point's entries.
  void normals(std::span<const float> heights, std::span<Vec3f> normals) const;

  static constexpr std::size_t lanes = 8;
  static constexpr std::size_t window = 256;  // number of points whose rows are sorted together

  using Others = std::array<Index, lanes>;
  using Coefficients = std::array<float, 2 * lanes>;  // x and y of lane 0, then of lane 1 and so on

  struct Pattern {
    std::size_t size = 0;
    // Per lane: index of the point within its window. Surplus lanes repeat the last point.
    std::vector<std::uint8_t> points;
    std::vector<Index> begin;  // slice s has the slots begin[s] up to begin[s + 1]
    std::vector<Others> others;

    Index point(std::size_t place) const {
      return static_cast<Index>(place / window * window + points[place]);
    }
  };

 private:
  template <typename F>
  void for_runs(F&& f) const;

  std::shared_ptr<const Pattern> pattern_;
  std::vector<Coefficients> coefficients_;  // by slot
  bool owns_pattern_ = true;
};

// Returns the matrix for SlicedEllMatrix::normals(). The normal of a point is the normalised sum of the cross
// products of its triangles inside the relief; without such triangles it is (0, 0, 1). With fixed x and y the
// sum is linear in the heights.
//
// If `like` is given, its pattern is reused. The entries of `like` must be in ascending order of the
// neighbours.
SlicedEllMatrix vertex_normal_matrix(std::span<const Vec2> points, const Triangulation& triangulation,
                                     const Boundary& boundary, const SlicedEllMatrix* like = nullptr);

}  // namespace relievo
