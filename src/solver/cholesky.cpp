#include "relievo/solver/cholesky.h"

#include <cmath>
#include <numeric>

#include "core/lists.h"
#include "core/memory.h"
#include "geometry/hilbert.h"
#include "relievo/core/text.h"
#include "solver/cholesky_factor.h"
#include "solver/dissection.h"

namespace relievo::solver {
namespace {

Error not_positive_definite(std::string why) {
  return {ErrorKind::geometry, "matrix", {}, "expected a symmetric positive definite matrix, " + why};
}

using Entries = Eigen::SparseMatrix<double>::InnerIterator;

bool is_finite(const Eigen::SparseMatrix<double>& A) {
  for (int j = 0; j < A.outerSize(); ++j)
    for (Entries entry(A, j); entry; ++entry)
      if (!std::isfinite(entry.value())) return false;
  return true;
}

// Calls f(column, row, value) for each entry below the diagonal.
template <typename F>
void for_each_below(const Eigen::SparseMatrix<double>& A, F&& f) {
  for (int j = 0; j < A.outerSize(); ++j)
    for (Entries entry(A, j); entry; ++entry)
      if (entry.row() > j) f(static_cast<Index>(j), static_cast<Index>(entry.row()), entry.value());
}

// Returns the graph of A in which vertex v is the unknown `order[v]`. Diagonal entries that are stored several times
// are summed.
WeightedGraph graph_of(const Eigen::SparseMatrix<double>& A, std::span<const Index> order) {
  WeightedGraph result;
  const auto n = static_cast<Index>(A.cols());
  std::vector<Index>& begin = result.graph.begin;
  begin.assign(n + 1, 0);
  std::vector<Index> vertex(n);
  for (Index v = 0; v < n; ++v) vertex[order[v]] = v;
  for_each_below(A, [&](Index j, Index i, double) { ++begin[vertex[i] + 1], ++begin[vertex[j] + 1]; });
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  result.graph.to.resize(begin[n]);
  result.weight.resize(begin[n]);
  std::vector<Index> next(begin.begin(), begin.end() - 1);
  const auto add = [&](Index from, Index to, double value) {
    result.graph.to[next[from]] = to;
    result.weight[next[from]++] = value;
  };
  for_each_below(A, [&](Index j, Index i, double value) {
    add(vertex[i], vertex[j], value);
    add(vertex[j], vertex[i], value);
  });
  result.diagonal.assign(n, 0.0);
  for (int j = 0; j < A.outerSize(); ++j)
    for (Entries entry(A, j); entry; ++entry)
      if (entry.row() == j) result.diagonal[vertex[static_cast<std::size_t>(j)]] += entry.value();
  return result;
}

}  // namespace

Cholesky::Cholesky(std::unique_ptr<Factor> factor) : factor_(std::move(factor)) {}
Cholesky::Cholesky(Cholesky&&) noexcept = default;
Cholesky& Cholesky::operator=(Cholesky&&) noexcept = default;
Cholesky::~Cholesky() = default;

Result<Cholesky> Cholesky::factor(const Eigen::SparseMatrix<double>& A, std::span<const Vec2> positions) {
  if (A.rows() != A.cols()) return std::unexpected(not_positive_definite("found one that is not square"));
  if (!is_finite(A)) return std::unexpected(not_positive_definite("found an entry that is not finite"));
  if (!positions.empty() && positions.size() != static_cast<std::size_t>(A.cols()))
    return option_error("positions", cat("expected one per unknown, found ", positions.size()));
  // Vertices are numbered along a space-filling curve, so that later steps access memory in order.
  std::vector<Eigen::Vector2f> places = in_unit_square(positions);
  places.resize(static_cast<std::size_t>(A.cols()), Eigen::Vector2f::Zero());
  const std::vector<Index> vertices = plane_order(places);
  const WeightedGraph graph = graph_of(A, vertices);
  std::unique_ptr<Factor> factor =
      build_task_tree(analyse(graph.graph, dissection_order(graph.graph, pick(places, vertices))));
  const Index failed_column = graph.graph.size() > 0 ? factorise(graph, *factor) : no_index;
  for (Index& vertex : factor->order) vertex = vertices[vertex];
  const Index failed = failed_column == no_index ? no_index : factor->order[failed_column];
  if (failed != no_index) {
    Error error = not_positive_definite("found a pivot that is not positive");
    error.place = "unknown " + std::to_string(failed);
    return std::unexpected(error);
  }
  return Cholesky(std::move(factor));
}

std::size_t Cholesky::size() const {
  return factor_->order.size();
}

void Cholesky::renumber(std::span<const Index> numbers) {
  for (Index& unknown : factor_->order) unknown = numbers[unknown];
}

std::size_t Cholesky::memory() const {
  const Factor& f = *factor_;
  return bytes(f.order) + bytes(f.tasks) + bytes(f.children) + bytes(f.boundary) + bytes(f.to_parent) +
         bytes(f.nodes) + bytes(f.rows) + f.value_count * sizeof(float) + bytes(f.matrix.diagonal) +
         bytes(f.matrix.begin) + bytes(f.matrix.to) + bytes(f.matrix.value) + bytes(f.matrix.rest);
}

}  // namespace relievo::solver
