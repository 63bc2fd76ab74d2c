#include "relief/height_equations.h"

#include <algorithm>

#include "core/groups.h"
#include "relief/edge_weight.h"

namespace relievo {
namespace {

struct WeightedEdge {
  Index from, to;
  float weight;
};

// Equation (9): the terms, one per triangle and edge, in both directions. An edge of two triangles has two.
std::vector<WeightedEdge> edge_terms(std::span<const Vec2> points, const Triangulation& mesh,
                                     const Boundary& boundary) {
  std::vector<WeightedEdge> edges;
  edges.reserve(mesh.triangles.size() * 6);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!boundary.is_inside[t]) continue;
    for (int corner = 0; corner < 3; ++corner) {
      const Index apex = mesh.triangles[t][corner];
      const Index a = mesh.triangles[t][(corner + 1) % 3], b = mesh.triangles[t][(corner + 2) % 3];
      const auto half = static_cast<float>(half_edge_weight(points[apex], points[a], points[b]));
      edges.push_back({a, b, half});
      edges.push_back({b, a, half});
    }
  }
  return edges;
}

// The edges of point i are edges[begin[i]] up to edges[begin[i + 1]], in ascending order of the other points.
struct Adjacency {
  std::vector<Index> begin;
  std::vector<WeightedEdge> edges;
};

// Equation (9): adds up the two terms of each edge and bounds its weight. Edges at depth jumps then count
// for their jump_share().
Adjacency gather(const std::vector<WeightedEdge>& all, const Boundary& boundary,
                 std::span<const float> weights) {
  const std::size_t points = boundary.is_boundary.size();
  auto [begin, sorted] = grouped<WeightedEdge, std::size_t>(points, [&](auto&& add) {
    for (const WeightedEdge& e : all) add(e.from, e);
  });

  Adjacency result;
  result.begin.reserve(points + 1);
  result.edges.reserve(all.size() / 2 + points);
  for (std::size_t i = 0; i < points; ++i) {
    result.begin.push_back(static_cast<Index>(result.edges.size()));
    const auto first = sorted.begin() + static_cast<std::ptrdiff_t>(begin[i]);
    const auto last = sorted.begin() + static_cast<std::ptrdiff_t>(begin[i + 1]);
    std::stable_sort(first, last, [](const WeightedEdge& a, const WeightedEdge& b) { return a.to < b.to; });
    for (auto e = first; e != last; ++e) {
      if (e != first && e->to == result.edges.back().to)
        result.edges.back().weight += e->weight;
      else
        result.edges.push_back(*e);
    }
  }
  result.begin.push_back(static_cast<Index>(result.edges.size()));
  for (WeightedEdge& e : result.edges) {
    e.weight = edge_weight(e.weight);
    if (!weights.empty()) e.weight *= jump_share(boundary, weights, e.from, e.to);
  }
  return result;
}

// Equation (9): the matrix of its normal equations, a weighted Laplacian; boundary points, at 0, drop out.
Eigen::SparseMatrix<double> laplacian(const Adjacency& adjacency, std::span<const Index> unknown,
                                      std::span<const Index> free_points) {
  const std::size_t n = free_points.size();
  std::vector<Eigen::Triplet<double, int>> entries;
  entries.reserve(n + adjacency.edges.size() / 2);
  for (std::size_t f = 0; f < n; ++f) {
    const Index i = free_points[f];
    double diagonal = 0;
    for (Index e = adjacency.begin[i]; e < adjacency.begin[i + 1]; ++e) {
      const WeightedEdge& edge = adjacency.edges[e];
      const auto weight = static_cast<double>(edge.weight);
      diagonal += weight;
      const Index other = unknown[edge.to];
      if (other != no_index && other < f)
        entries.emplace_back(static_cast<int>(f), static_cast<int>(other), -weight);
    }
    entries.emplace_back(static_cast<int>(f), static_cast<int>(f), diagonal);
  }
  Eigen::SparseMatrix<double> A(static_cast<int>(n), static_cast<int>(n));
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

// Equation (9): the right-hand side of a point is the sum over its edges of weight / 2 (s_p + s_q) . (p - q).
void add_coefficients(std::span<const Vec2> points, const Adjacency& adjacency,
                      std::span<const Index> unknown, HeightEquations& equations) {
  equations.begin.reserve(points.size() + 1);
  equations.edges.reserve(adjacency.edges.size());
  for (Index i = 0; i < points.size(); ++i) {
    const bool is_free = unknown[i] != no_index;
    bool has_itself = is_free;
    for (Index e = adjacency.begin[i]; e < adjacency.begin[i + 1]; ++e) {
      const Index other = adjacency.edges[e].to;
      if (!has_itself && other > i) equations.edges.push_back({i}), has_itself = true;
      const double half = is_free ? .5 * static_cast<double>(adjacency.edges[e].weight) : 0;
      const Vec2 coefficient = half * (points[i] - points[other]);
      equations.edges.push_back({other, coefficient.cast<float>()});
    }
    if (!has_itself) equations.edges.push_back({i});
    equations.begin.push_back(static_cast<Index>(equations.edges.size()));
  }
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
  const Adjacency adjacency = gather(edge_terms(points, triangulation, boundary), boundary, weights);
  equations.A = laplacian(adjacency, unknown, equations.free_points);
  add_coefficients(points, adjacency, unknown, equations);
  return equations;
}

}  // namespace relievo
