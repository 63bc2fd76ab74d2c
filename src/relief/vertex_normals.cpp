#include "relief/vertex_normals.h"

#include <algorithm>
#include <cmath>

#include "geometry/plane.h"
#include "relief/matrix_rows.h"

namespace relievo {
namespace {

struct Term {
  Index other;
  Vec2 coefficient;
};

double twice_area(std::span<const Vec2> points, const Triangle& t) {
  return cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]);
}

// Makes rows of the matrix one after the other. Corner i of triangle t has the number 3 t + i.
class NormalRows {
 public:
  NormalRows(std::span<const Vec2> points, const std::vector<Triangle>& triangles)
      : points_(points), triangles_(triangles) {}

  // Adds the row of a point to `entries`: the derivatives, by heights, of the sum of its triangles' cross
  // products, divided by z of that sum, which does not depend on heights.
  void add(std::span<const Index> corners, std::vector<MatrixEntry>& entries) {
    terms_.clear();
    double z = 0;
    for (const Index corner : corners) {
      add_terms(triangles_[corner / 3], corner % 3);
      z += twice_area(points_, triangles_[corner / 3]);
    }
    for (auto term = terms_.begin(); term != terms_.end();) {
      Vec2 coefficient = Vec2::Zero();
      const Index other = term->other;
      for (; term != terms_.end() && term->other == other; ++term) coefficient += term->coefficient;
      // The point's own height cancels where triangles close around it.
      const bool cancels = coefficient.norm() <= 1e-12 * std::sqrt(z);
      if (!cancels && z > 0) entries.push_back({other, (coefficient / z).cast<float>()});
    }
  }

 private:
  // Adds the derivatives of the cross product at `a`, (b - a) x (c - a), by the height of each corner.
  void add_terms(const Triangle& t, Index corner) {
    const Index a = t[corner], b = t[(corner + 1) % 3], c = t[(corner + 2) % 3];
    const Vec2 ab = points_[b] - points_[a], ac = points_[c] - points_[a], bc = points_[c] - points_[b];
    insert({a, {bc.y(), -bc.x()}});
    insert({b, {-ac.y(), ac.x()}});
    insert({c, {ab.y(), -ab.x()}});
  }

  // Keeps the terms sorted; those of one point stay in the order in which they came.
  void insert(const Term& term) {
    terms_.insert(std::ranges::upper_bound(terms_, term.other, {}, &Term::other), term);
  }

  std::span<const Vec2> points_;
  const std::vector<Triangle>& triangles_;
  std::vector<Term> terms_;
};

}  // namespace

SlicedEllMatrix vertex_normal_matrix(std::span<const Vec2> points, const Triangulation& triangulation,
                                     const Boundary& boundary, const SlicedEllMatrix* like) {
  const std::vector<Triangle>& triangles = triangulation.triangles;
  const Groups<Index> corners = corners_inside(points.size(), triangles, boundary);
  const auto entries =
      rows_in_order<MatrixEntry>(points.size(), [&](std::size_t first, std::size_t end, auto&& row) {
        NormalRows rows(points, triangles);
        for (std::size_t i = first; i < end; ++i)
          row(i, [&](std::vector<MatrixEntry>& added) { rows.add(corners[i], added); });
      });
  return like ? SlicedEllMatrix(entries, *like) : SlicedEllMatrix(entries);
}

}  // namespace relievo
