#include "relief/height_equations.h"

#include <algorithm>
#include <numeric>

#include "relief/edge_weight.h"
#include "relief/matrix_rows.h"

namespace relievo {
namespace {

struct WeightedEdge {
  Index to;
  float weight;
};

// The edges of each point, in ascending order of the other points.
using Adjacency = Groups<WeightedEdge>;

// Computes the weighted edges of points in equation (9), one point after the other. Corner i of triangle t
// has the number 3 t + i.
class EdgeRows {
 public:
  EdgeRows(std::span<const Vec2> points, const std::vector<Triangle>& triangles)
      : points_(points), triangles_(triangles) {}

  // Adds the edges of a point to `edges`. The weight of an edge is the sum of one term for each of its
  // triangles.
  void add(std::span<const Index> corners, std::vector<WeightedEdge>& edges) {
    terms_.clear();
    for (const Index corner : corners) {
      const Triangle& t = triangles_[corner / 3];
      const Index own = t[corner % 3], next = t[(corner + 1) % 3], last = t[(corner + 2) % 3];
      insert({next, half_weight(last, own, next)});
      insert({last, half_weight(next, last, own)});
    }
    for (std::size_t i = 0; i < terms_.size(); ++i)
      if (i > 0 && terms_[i].to == terms_[i - 1].to)
        edges.back().weight += terms_[i].weight;
      else
        edges.push_back(terms_[i]);
  }

 private:
  float half_weight(Index apex, Index a, Index b) const {
    return static_cast<float>(half_edge_weight(points_[apex], points_[a], points_[b]));
  }

  // Keeps the terms sorted; those of one edge stay in the order in which they came.
  void insert(const WeightedEdge& term) {
    terms_.insert(std::ranges::upper_bound(terms_, term.to, {}, &WeightedEdge::to), term);
  }

  std::span<const Vec2> points_;
  const std::vector<Triangle>& triangles_;
  std::vector<WeightedEdge> terms_;
};

// Returns the edges of triangles inside, with their edge_weight().
Adjacency adjacency_of(std::span<const Vec2> points, const std::vector<Triangle>& triangles,
                       const Boundary& boundary, std::span<const float> weights) {
  const Groups<Index> corners = corners_inside(points.size(), triangles, boundary);
  return rows_in_order<WeightedEdge>(points.size(), [&](std::size_t first, std::size_t end, auto&& row) {
    EdgeRows rows(points, triangles);
    for (std::size_t i = first; i < end; ++i)
      row(i, [&](std::vector<WeightedEdge>& edges) {
        const std::size_t before = edges.size();
        rows.add(corners[i], edges);
        for (std::size_t e = before; e < edges.size(); ++e)
          edges[e].weight =
              edge_weight(edges[e].weight, boundary, weights, static_cast<Index>(i), edges[e].to);
      });
  });
}

// Returns the matrix of the normal equations of (9), a weighted Laplacian. Boundary points have height 0 and
// drop out.
Eigen::SparseMatrix<double> laplacian(const Adjacency& adjacency, std::span<const Index> unknown,
                                      std::span<const Index> free_points) {
  const auto n = static_cast<int>(free_points.size());
  Eigen::SparseMatrix<double> A(n, n);
  const auto is_below = [&](const WeightedEdge& edge, std::size_t column) {
    return unknown[edge.to] != no_index && unknown[edge.to] > column;
  };
  int* const begin = A.outerIndexPtr();
  parallel_for(free_points.size(), [&](std::size_t f) {
    const auto edges = adjacency[free_points[f]];
    begin[f + 1] =
        1 + static_cast<int>(std::ranges::count_if(edges, [&](const auto& e) { return is_below(e, f); }));
  });
  std::partial_sum(begin, begin + n + 1, begin);
  A.resizeNonZeros(begin[n]);
  parallel_for(free_points.size(), [&](std::size_t f) {
    int at = begin[f];
    double& diagonal = A.valuePtr()[at];
    A.innerIndexPtr()[at++] = static_cast<int>(f);
    diagonal = 0;
    for (const WeightedEdge& edge : adjacency[free_points[f]]) {
      diagonal += static_cast<double>(edge.weight);
      if (!is_below(edge, f)) continue;
      A.innerIndexPtr()[at] = static_cast<int>(unknown[edge.to]);
      A.valuePtr()[at++] = -static_cast<double>(edge.weight);
    }
  });
  return A;
}

// Returns the coefficients of the right-hand side of (9). For point p it is the sum over its edges of weight
// / 2 (s_p + s_q) . (p - q).
Groups<MatrixEntry> coefficients_of(std::span<const Vec2> points, const Adjacency& adjacency,
                                    std::span<const Index> unknown) {
  const auto add = [&](Index i, std::vector<MatrixEntry>& entries) {
    const bool is_free = unknown[i] != no_index;
    bool has_itself = is_free;
    for (const auto& [other, weight] : adjacency[i]) {
      if (!has_itself && other > i) entries.push_back({i}), has_itself = true;
      const double half = is_free ? .5 * static_cast<double>(weight) : 0;
      const Vec2 coefficient = half * (points[i] - points[other]);
      entries.push_back({other, coefficient.cast<float>()});
    }
    if (!has_itself) entries.push_back({i});
  };
  return rows_in_order<MatrixEntry>(points.size(), [&](std::size_t first, std::size_t end, auto&& row) {
    for (std::size_t i = first; i < end; ++i)
      row(i, [&](std::vector<MatrixEntry>& entries) { add(static_cast<Index>(i), entries); });
  });
}

}  // namespace

HeightEquations height_equations(std::span<const Vec2> points, const Triangulation& triangulation,
                                 const Boundary& boundary, std::span<const float> weights) {
  HeightEquations equations;
  std::vector<Index> unknown(points.size(), no_index);
  for (Index i = 0; i < points.size(); ++i) {
    if (boundary.is_boundary[i]) continue;
    unknown[i] = static_cast<Index>(equations.free_points.size());
    equations.free_points.push_back(i);
  }
  const Adjacency adjacency = adjacency_of(points, triangulation.triangles, boundary, weights);
  equations.A = laplacian(adjacency, unknown, equations.free_points);
  equations.edges = coefficients_of(points, adjacency, unknown);
  return equations;
}

}  // namespace relievo
