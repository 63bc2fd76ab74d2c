#include "relief/vertex_normals.h"

#include <algorithm>
#include <cmath>

#include "geometry/plane.h"

namespace relievo {
namespace {

struct Term {
  Index point, other;
  Vec2 coefficient;
};

// Adds the derivatives of the triangle's cross product at `a`, (b - a) x (c - a), by the height of each corner.
void add_terms(std::span<const Vec2> points, Index a, Index b, Index c, std::vector<Term>& terms) {
  const Vec2 ab = points[b] - points[a], ac = points[c] - points[a], bc = points[c] - points[b];
  terms.push_back({a, a, {bc.y(), -bc.x()}});
  terms.push_back({a, b, {-ac.y(), ac.x()}});
  terms.push_back({a, c, {ab.y(), -ab.x()}});
}

double twice_area(std::span<const Vec2> points, const Triangle& t) {
  return cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]);
}

}  // namespace

SlicedEllMatrix vertex_normal_matrix(std::span<const Vec2> points, const Triangulation& triangulation,
                                     const Boundary& boundary, const SlicedEllMatrix* like) {
  std::vector<double> z(points.size(),
                        0.0);  // z of the sum of cross products, which does not depend on heights
  std::vector<Index> count(points.size() + 1, 0);
  std::vector<Term> terms;
  terms.reserve(triangulation.triangles.size() * 9);
  for (std::size_t t = 0; t < triangulation.triangles.size(); ++t) {
    if (!boundary.is_inside[t]) continue;
    const auto [a, b, c] = triangulation.triangles[t];
    add_terms(points, a, b, c, terms);
    add_terms(points, b, c, a, terms);
    add_terms(points, c, a, b, terms);
    for (const Index corner : {a, b, c}) {
      z[corner] += twice_area(points, {a, b, c});
      count[corner + 1] += 3;
    }
  }
  for (std::size_t i = 0; i < points.size(); ++i) count[i + 1] += count[i];
  std::vector<Term> sorted(terms.size());
  std::vector<Index> next(count.begin(), count.end() - 1);
  for (const Term& term : terms) sorted[next[term.point]++] = term;

  std::vector<Index> begin;
  std::vector<MatrixEntry> entries;
  begin.reserve(points.size() + 1);
  entries.reserve(terms.size() * 7 / 18 + 16);
  for (std::size_t i = 0; i < points.size(); ++i) {
    begin.push_back(static_cast<Index>(entries.size()));
    const auto first = sorted.begin() + count[i], last = sorted.begin() + count[i + 1];
    std::stable_sort(first, last, [](const Term& p, const Term& q) { return p.other < q.other; });
    for (auto term = first; term != last;) {
      Vec2 coefficient = Vec2::Zero();
      const Index other = term->other;
      for (; term != last && term->other == other; ++term) coefficient += term->coefficient;
      // The point's own height cancels where triangles close around it.
      const bool cancels = coefficient.norm() <= 1e-12 * std::sqrt(z[i]);
      if (!cancels && z[i] > 0) entries.push_back({other, (coefficient / z[i]).cast<float>()});
    }
  }
  begin.push_back(static_cast<Index>(entries.size()));
  return like ? SlicedEllMatrix(begin, entries, *like) : SlicedEllMatrix(begin, entries);
}

}  // namespace relievo
