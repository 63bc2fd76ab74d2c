#include "paper/heights.h"

#include <algorithm>
#include <array>

#include "core/disjoint_sets.h"
#include "core/memory.h"
#include "geometry/neighbours.h"
#include "relievo/core/parallel.h"

namespace relievo::paper {
namespace {

constexpr std::size_t neighbours_of_each = 6;
using Neighbours = std::vector<std::vector<Index>>;

// Returns the points nearest to each point, without the point itself.
Neighbours nearest_in_plane(std::span<const Vec2> points) {
  const KdTree<Vec2> tree(points);
  Neighbours neighbours(points.size());
  parallel_for(points.size(), [&](std::size_t p) {
    std::array<Index, neighbours_of_each + 1> found;
    std::array<double, neighbours_of_each + 1> distances_sq;
    const std::size_t count = tree.nearest(points[p], found.size(), found.data(), distances_sq.data());
    std::vector<Index>& own = neighbours[p];
    for (std::size_t i = 0; i < count && own.size() < neighbours_of_each; ++i)
      if (found[i] != p) own.push_back(found[i]);
  });
  return neighbours;
}

// Returns the indices of the points that are set to the height of the base: all boundary points, and one point of
// each connected set without a boundary point.
std::vector<Index> points_on_base(std::span<const std::uint8_t> is_boundary, const Neighbours& neighbours) {
  DisjointSets sets(is_boundary.size());
  for (Index p = 0; p < neighbours.size(); ++p)
    for (const Index q : neighbours[p]) sets.join(p, q);
  std::vector<std::uint8_t> has_base(is_boundary.size(), 0);
  std::vector<Index> on_base;
  for (Index p = 0; p < is_boundary.size(); ++p)
    if (is_boundary[p]) on_base.push_back(p), has_base[sets.find(p)] = 1;
  for (Index p = 0; p < is_boundary.size(); ++p)
    if (!std::exchange(has_base[sets.find(p)], 1)) on_base.push_back(p);
  return on_base;
}

// Returns A^T A, the Gram matrix of (9).
Eigen::SparseMatrix<double> gram_matrix(const Neighbours& neighbours, std::span<const Index> on_base) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(4 * neighbours_of_each * neighbours.size() + on_base.size());
  for (const Index p : on_base) entries.emplace_back(p, p, 1);
  for (Index p = 0; p < neighbours.size(); ++p)
    for (const Index q : neighbours[p]) {
      entries.emplace_back(p, p, 1);
      entries.emplace_back(q, q, 1);
      entries.emplace_back(p, q, -1);
      entries.emplace_back(q, p, -1);
    }
  const auto n = static_cast<Eigen::Index>(neighbours.size());
  Eigen::SparseMatrix<double> AtA(n, n);
  AtA.setFromTriplets(entries.begin(), entries.end());
  return AtA;
}

}  // namespace

Result<NormalEquations> NormalEquations::build(std::span<const Vec2> points,
                                               std::span<const std::uint8_t> is_boundary) {
  const Neighbours neighbours = nearest_in_plane(points);
  const std::vector<Index> on_base = points_on_base(is_boundary, neighbours);
  RELIEVO_TRY(auto factor, solver::Cholesky::factor(gram_matrix(neighbours, on_base), points));
  NormalEquations made(std::move(factor));
  made.steps_.assign(points.size(), Vec2f::Zero());
  made.rows_ = grouped<Row>(points.size(), [&](auto&& add) {
    for (Index p = 0; p < points.size(); ++p)
      for (const Index q : neighbours[p]) add(q, Row{p, (points[p] - points[q]).cast<float>()});
  });
  for (const Row& row : made.rows_.items) made.steps_[row.p] += row.step;
  return made;
}

std::size_t NormalEquations::memory() const {
  return factor_.memory() + bytes(steps_) + bytes(rows_.begin) + bytes(rows_.items);
}

// The right-hand side is A^T b. For each row z_p - z_q = s_p . (p - q), the number s_p . (p - q) is added to element p
// of A^T b and subtracted from element q.
void NormalEquations::solve(std::span<const Vec2f> slopes, std::span<float> heights,
                            Workspace& workspace) const {
  parallel_for(size(), [&](std::size_t i) {
    float sum = slopes[i].dot(steps_[i]);
    for (const Row& row : rows_[i]) sum -= slopes[row.p].dot(row.step);
    heights[i] = sum;
  });
  factor_.solve(heights, heights, workspace);
}

}  // namespace relievo::paper
