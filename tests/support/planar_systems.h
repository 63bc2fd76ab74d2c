// Makes random systems of equations for tests of the solver. The unknowns are the points of a planar grid.
#pragma once

#include <Eigen/SparseCore>

#include "solver/dissection.h"
#include "support/shapes.h"

namespace relievo::test {

using Sparse = Eigen::SparseMatrix<double>;

// The lower triangle of a positive definite matrix, and the positions of its unknowns.
struct PlanarSystem {
  Sparse A;
  std::vector<Vec2> positions;
};

// Returns the Laplacian of a grid of unit squares, each divided by one of its diagonals. Points are displaced
// at random, and edges have random weights. At the edge of the grid, 1 is added to the diagonal of the
// matrix, which makes the matrix definite.
inline PlanarSystem jittered_grid(int width, int height, std::uint64_t seed = 7) {
  Random random(seed);
  PlanarSystem system;
  const int n = width * height;
  Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(n);
  std::vector<Eigen::Triplet<double>> entries;
  const auto join = [&](int a, int b) {
    const double weight = random.uniform(.1, 2);
    entries.emplace_back(std::max(a, b), std::min(a, b), -weight);
    diagonal[a] += weight;
    diagonal[b] += weight;
  };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int v = y * width + x;
      system.positions.emplace_back(x + random.uniform(-.3, .3), y + random.uniform(-.3, .3));
      if (x == 0 || y == 0 || x == width - 1 || y == height - 1) diagonal[v] += 1;
      if (x + 1 < width) join(v, v + 1);
      if (y + 1 < height) join(v, v + width);
      if (x + 1 < width && y + 1 < height)
        random.bits() % 2 ? join(v, v + width + 1) : join(v + 1, v + width);
    }
  for (int v = 0; v < n; ++v) entries.emplace_back(v, v, diagonal[v]);
  system.A.resize(n, n);
  system.A.setFromTriplets(entries.begin(), entries.end());
  return system;
}

inline solver::Graph graph_of(const Sparse& A) {
  std::vector<std::vector<Index>> nearby(static_cast<std::size_t>(A.cols()));
  for (int j = 0; j < A.outerSize(); ++j)
    for (Sparse::InnerIterator entry(A, j); entry; ++entry)
      if (entry.row() > j) {
        nearby[static_cast<std::size_t>(j)].push_back(static_cast<Index>(entry.row()));
        nearby[static_cast<std::size_t>(entry.row())].push_back(static_cast<Index>(j));
      }
  solver::Graph graph;
  for (const auto& list : nearby) {
    graph.to.insert(graph.to.end(), list.begin(), list.end());
    graph.begin.push_back(static_cast<Index>(graph.to.size()));
  }
  return graph;
}

inline std::vector<Vec2> shuffled(std::vector<Vec2> positions, std::uint64_t seed = 8) {
  Random random(seed);
  for (std::size_t i = positions.size(); i > 1; --i)
    std::swap(positions[i - 1], positions[random.bits() % i]);
  return positions;
}

inline Eigen::VectorXd random_vector(Eigen::Index n, std::uint64_t seed = 9) {
  Random random(seed);
  Eigen::VectorXd v(n);
  for (double& element : v) element = random.uniform(-1, 1);
  return v;
}

}  // namespace relievo::test
