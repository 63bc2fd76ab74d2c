#include "relievo/relief/heights.h"

#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/groups.h"
#include "core/lists.h"
#include "geometry/plane.h"
#include "relief/edge_weight.h"
#include "relief/sliced_ell_matrix.h"
#include "relievo/core/parallel.h"

namespace relievo {
namespace {

// Returns, for each point, the triangle corners at this point, in ascending order. Only triangles inside
// the relief count. Corner i of triangle t has the number 3 t + i.
Groups<Index> corners_inside(std::size_t points, const std::vector<Triangle>& triangles,
                             const Boundary& boundary) {
  return grouped<Index>(points, [&](auto&& add) {
    for (Index t = 0; t < triangles.size(); ++t)
      for (Index i = 0; i < 3 && boundary.is_inside[t]; ++i) add(triangles[t][i], 3 * t + i);
  });
}

// Returns the entries of all rows. add_row(i, entries) appends the entries of row i; each task calls its own
// copy of `add_row`.
template <typename Entry, typename AddRow>
Groups<Entry> rows_in_order(std::size_t rows, const AddRow& add_row) {
  Groups<Entry> all{std::vector<Index>(rows + 1), {}};
  std::vector<std::vector<Entry>> parts((rows + default_grain - 1) / default_grain);
  parallel_ranges(rows, default_grain, [&](std::size_t first, std::size_t end) {
    std::vector<Entry>& part = parts[first / default_grain];
    part.reserve(8 * (end - first));
    AddRow add = add_row;
    for (std::size_t i = first; i < end; ++i) {
      const std::size_t before = part.size();
      add(static_cast<Index>(i), part);
      all.begin[i + 1] = static_cast<Index>(part.size() - before);
    }
  });
  std::partial_sum(all.begin.begin(), all.begin.end(), all.begin.begin());
  all.items.reserve(all.begin.back());
  for (std::vector<Entry>& part : parts) {
    all.items.insert(all.items.end(), part.begin(), part.end());
    part = {};
  }
  return all;
}

// The matrix of equation (9), and the coefficients from which its right-hand side is computed.
struct HeightEquations {
  std::vector<Index> free_points;  // point of each unknown; boundary points have no unknown
  Eigen::SparseMatrix<double> A;   // lower triangle of the weighted Laplacian; one row per unknown
  // The edges of each point, in ascending order of the points at their other ends. Every point also has an
  // edge to itself, so that vertex_normal_matrix() can reuse the pattern. The coefficient of an edge is half
  // the edge's weight times the vector to the point from the other end. Coefficients are 0 at boundary
  // points, whose heights are 0. SlicedEllMatrix::divergence() computes the right-hand side from the
  // coefficients.
  Groups<MatrixEntry> edges;
};

struct WeightedEdge {
  Index to;
  float weight;
};

// The edges of each point, in ascending order of the points at their other ends.
using Adjacency = Groups<WeightedEdge>;

// Computes the edges of equation (9) and their weights, point by point. Corner i of triangle t has the number 3 t + i.
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

  // Keeps the terms sorted by point. Terms of the same edge stay in the order of insertion.
  void insert(const WeightedEdge& term) {
    terms_.insert(std::ranges::upper_bound(terms_, term.to, {}, &WeightedEdge::to), term);
  }

  std::span<const Vec2> points_;
  const std::vector<Triangle>& triangles_;
  std::vector<WeightedEdge> terms_;
};

// Returns the edges of triangles inside the relief, with their edge_weight().
Adjacency adjacency_of(std::span<const Vec2> points, const std::vector<Triangle>& triangles,
                       const Boundary& boundary, std::span<const float> weights) {
  const Groups<Index> corners = corners_inside(points.size(), triangles, boundary);
  return rows_in_order<WeightedEdge>(points.size(), [&, rows = EdgeRows(points, triangles)](
                                                        Index i, std::vector<WeightedEdge>& edges) mutable {
    const std::size_t before = edges.size();
    rows.add(corners[i], edges);
    for (std::size_t e = before; e < edges.size(); ++e)
      edges[e].weight = edge_weight(edges[e].weight, weights, i, edges[e].to);
  });
}

// Returns the matrix of the normal equations of the least-squares problem (9), a weighted Laplacian.
// Boundary points have height 0, so they have no row.
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

// Returns the coefficients of the right-hand side of equation (9). The right-hand side of point p is a sum
// over its edges. The edge to point q contributes weight / 2 (s_p + s_q) . (p - q), where s are the slopes at
// both points.
Groups<MatrixEntry> coefficients_of(std::span<const Vec2> points, const Adjacency& adjacency,
                                    std::span<const Index> unknown) {
  return rows_in_order<MatrixEntry>(points.size(), [&](Index i, std::vector<MatrixEntry>& entries) {
    const bool is_free = unknown[i] != no_index;
    bool has_itself = is_free;
    for (const auto& [other, weight] : adjacency[i]) {
      if (!has_itself && other > i) entries.push_back({i}), has_itself = true;
      const double half = is_free ? .5 * static_cast<double>(weight) : 0;
      const Vec2 coefficient = half * (points[i] - points[other]);
      entries.push_back({other, coefficient.cast<float>()});
    }
    if (!has_itself) entries.push_back({i});
  });
}

// Returns the equations. `weights` are the same as for HeightSystem::build().
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

struct Term {
  Index other;
  Vec2 coefficient;
};

// Computes the rows of vertex_normal_matrix(), point by point. Corner i of triangle t has the number 3 t + i.
class NormalRows {
 public:
  NormalRows(std::span<const Vec2> points, const std::vector<Triangle>& triangles)
      : points_(points), triangles_(triangles) {}

  // Adds the row of a point to `entries`. The normal is N / N_z, where N is the sum of the cross products of
  // the point's triangles. N_z does not depend on heights, and N is linear in the heights. So the row
  // consists of the derivatives of N with respect to the heights, divided by N_z.
  void add(std::span<const Index> corners, std::vector<MatrixEntry>& entries) {
    terms_.clear();
    double z = 0;
    for (const Index corner : corners) {
      const Triangle& t = triangles_[corner / 3];
      add_terms(t, corner % 3);
      z += twice_area(points_[t[0]], points_[t[1]], points_[t[2]]);
    }
    for (auto term = terms_.begin(); term != terms_.end();) {
      Vec2 coefficient = Vec2::Zero();
      const Index other = term->other;
      for (; term != terms_.end() && term->other == other; ++term) coefficient += term->coefficient;
      // The derivative with respect to the point's own height is 0 if triangles surround the point.
      const bool cancels = coefficient.norm() <= 1e-12 * std::sqrt(z);
      if (!cancels && z > 0) entries.push_back({other, (coefficient / z).cast<float>()});
    }
  }

 private:
  // Adds the derivatives of the cross product at `a`, (b - a) x (c - a), with respect to the height of each corner.
  void add_terms(const Triangle& t, Index corner) {
    const Index a = t[corner], b = t[(corner + 1) % 3], c = t[(corner + 2) % 3];
    const Vec2 ab = points_[b] - points_[a], ac = points_[c] - points_[a], bc = points_[c] - points_[b];
    insert({a, {bc.y(), -bc.x()}});
    insert({b, {-ac.y(), ac.x()}});
    insert({c, {ab.y(), -ab.x()}});
  }

  // Keeps the terms sorted by point. Terms of the same point stay in the order of insertion.
  void insert(const Term& term) {
    terms_.insert(std::ranges::upper_bound(terms_, term.other, {}, &Term::other), term);
  }

  std::span<const Vec2> points_;
  const std::vector<Triangle>& triangles_;
  std::vector<Term> terms_;
};

}  // namespace

Result<HeightSystem> HeightSystem::build(std::span<const Vec2> points, const Triangulation& triangulation,
                                         const Boundary& boundary, std::span<const float> weights) {
  const HeightEquations equations = height_equations(points, triangulation, boundary, weights);
  RELIEVO_TRY(solver::Cholesky factor,
              solver::Cholesky::factor(equations.A, pick(points, equations.free_points)));
  factor.renumber(equations.free_points);
  return HeightSystem(std::move(factor), SlicedEllMatrix(equations.edges));
}

HeightSystem::HeightSystem(solver::Cholesky factor, SlicedEllMatrix edges)
    : factor_(std::move(factor)), edges_(std::make_unique<SlicedEllMatrix>(std::move(edges))) {}
HeightSystem::HeightSystem(HeightSystem&&) noexcept = default;
HeightSystem& HeightSystem::operator=(HeightSystem&&) noexcept = default;
HeightSystem::~HeightSystem() = default;

std::size_t HeightSystem::size() const {
  return edges_->size();
}

std::size_t HeightSystem::memory() const {
  return factor_.memory() + edges_->memory();
}

// The coefficients of boundary points are 0. So their right-hand side is 0, and solve() leaves 0 as their height.
void HeightSystem::solve(std::span<const Vec2> slopes, std::span<double> heights) const {
  edges_->divergence(slopes, heights);
  factor_.solve(heights, heights);
}

void HeightSystem::solve(std::span<const Vec2f> slopes, std::span<float> heights,
                         Workspace& workspace) const {
  edges_->divergence(slopes, heights);
  factor_.solve(heights, heights, workspace);
}

void HeightSystem::solve_in_place(std::span<double> heights) const {
  factor_.solve(heights, heights);
}

void HeightSystem::solve_in_place(std::span<float> heights, Workspace& workspace) const {
  factor_.solve(heights, heights, workspace);
}

SlicedEllMatrix vertex_normal_matrix(std::span<const Vec2> points, const Triangulation& triangulation,
                                     const Boundary& boundary, const SlicedEllMatrix* like) {
  const std::vector<Triangle>& triangles = triangulation.triangles;
  const Groups<Index> corners = corners_inside(points.size(), triangles, boundary);
  const auto entries = rows_in_order<MatrixEntry>(
      points.size(), [&, rows = NormalRows(points, triangles)](
                         Index i, std::vector<MatrixEntry>& added) mutable { rows.add(corners[i], added); });
  return like ? SlicedEllMatrix(entries, *like) : SlicedEllMatrix(entries);
}

}  // namespace relievo
