// Solves equation (9), in the form that our method uses, by Eigen and independently of HeightSystem.
#pragma once

#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "relievo/scan/boundary.h"

namespace relievo::test {

// The points and edges of equation (9), and the weights of the points. If `weights` is empty, all weights are 1.
struct EquationNine {
  std::vector<Vec2> points;
  const Triangulation& mesh;
  const Boundary& boundary;
  std::vector<float> weights = {};

  // Returns the weight of each edge (p, q) with p < q. It is half the sum of the cotangents of the opposite
  // angles, clamped to the range from 1e-4 to 1e3, times the mean of the weights of both ends.
  std::map<std::pair<Index, Index>, double> edges() const {
    std::map<std::pair<Index, Index>, double> edges;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (std::size_t corner = 0; corner < 3 && boundary.is_inside[t]; ++corner) {
        const auto& [apex, p, q] = turned(mesh.triangles[t], corner);
        const Vec2 u = points[p] - points[apex], v = points[q] - points[apex];
        edges[std::minmax(p, q)] += .5 * u.dot(v) / (u.x() * v.y() - u.y() * v.x());
      }
    for (auto& [ends, weight] : edges)
      weight = std::clamp(weight, 1e-4, 1e3) * factor(ends.first, ends.second);
    return edges;
  }

  double factor(Index p, Index q) const {
    if (weights.empty()) return 1;
    return static_cast<double>(weights[p] + weights[q]) / 2;
  }

 private:
  static Triangle turned(const Triangle& t, std::size_t by) {
    return {t[by], t[(by + 1) % 3], t[(by + 2) % 3]};
  }
};

// Returns the heights z that minimise the sum of
//   weight (z_p - z_q - (s_p + s_q)/2 . (p - q))^2
// over all edges (p, q), where s are the slopes, and z = 0 at boundary points.
inline std::vector<double> least_squares_heights(const EquationNine& nine, std::span<const Vec2> slopes) {
  const auto n = static_cast<Eigen::Index>(slopes.size());
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
  const auto is_known = [&](Index i) { return nine.boundary.is_boundary[i] != 0; };
  const auto add = [&](Index p, Index q, double weight) {
    if (is_known(p)) return;
    entries.emplace_back(p, p, weight);
    if (!is_known(q)) entries.emplace_back(p, q, -weight);
    right[p] += weight * .5 * (slopes[p] + slopes[q]).dot(nine.points[p] - nine.points[q]);
  };
  for (const auto& [ends, weight] : nine.edges()) {
    add(ends.first, ends.second, weight);
    add(ends.second, ends.first, weight);
  }
  for (Index i = 0; i < slopes.size(); ++i)
    if (is_known(i)) entries.emplace_back(i, i, 1);
  Eigen::SparseMatrix<double> A(n, n);
  A.setFromTriplets(entries.begin(), entries.end());
  const Eigen::VectorXd z = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(A).solve(right);
  return {z.begin(), z.end()};
}

}  // namespace relievo::test
