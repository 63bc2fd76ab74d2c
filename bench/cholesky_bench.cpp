// Times the Cholesky solver on Laplacians of Delaunay triangulations of random points, for several numbers of points.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "relievo/core/parallel.h"
#include "relievo/geometry/triangulation.h"
#include "relievo/solver/cholesky.h"

namespace relievo {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

struct System {
  Sparse A;
  std::vector<Vec2> positions;
  Eigen::VectorXd b;
};

// Returns random points in a disc with two holes, the same on every platform.
std::vector<Vec2> scattered(std::size_t n) {
  std::vector<Vec2> points;
  std::uint64_t state = 1;
  const auto uniform = [&state] {
    state = state * 6364136223846793005U + 1442695040888963407U;
    return static_cast<double>(state >> 11) * 0x1p-52 - 1;
  };
  while (points.size() < n) {
    const Vec2 p(uniform(), uniform());
    if (p.norm() < 1 && (p - Vec2(.3, .2)).norm() > .15 && (p + Vec2(.4, .1)).norm() > .1)
      points.push_back(p);
  }
  return points;
}

double half_cotangent(const Vec2& apex, const Vec2& a, const Vec2& b) {
  const Vec2 u = a - apex, v = b - apex;
  return .5 * u.dot(v) / std::max(u.x() * v.y() - u.y() * v.x(), 1e-300);
}

// Returns a system with cotangent weights, which are clamped like those of HeightSystem. At the points of the convex
// hull the solution is 0.
System make_system(std::size_t n) {
  System system;
  system.positions = scattered(n);
  const Triangulation mesh = delaunay(system.positions);
  const auto size = static_cast<Eigen::Index>(n);
  std::vector<Eigen::Triplet<double>> entries;
  for (Index v = 0; v < n; ++v) entries.emplace_back(static_cast<int>(v), static_cast<int>(v), 0);
  for (const Index v : mesh.hull) entries.emplace_back(static_cast<int>(v), static_cast<int>(v), 1);
  for (const Triangle& t : mesh.triangles)
    for (int corner = 0; corner < 3; ++corner) {
      const Index a = t[(corner + 1) % 3], b = t[(corner + 2) % 3];
      entries.emplace_back(
          static_cast<int>(std::max(a, b)), static_cast<int>(std::min(a, b)),
          -half_cotangent(system.positions[t[corner]], system.positions[a], system.positions[b]));
    }
  system.A.resize(size, size);
  system.A.setFromTriplets(entries.begin(), entries.end());
  for (int j = 0; j < size; ++j)
    for (Sparse::InnerIterator entry(system.A, j); entry; ++entry) {
      if (entry.row() == j) continue;
      entry.valueRef() = std::clamp(entry.value(), -1e3, -1e-4);
      system.A.coeffRef(j, j) -= entry.value();
      system.A.coeffRef(entry.row(), entry.row()) -= entry.value();
    }
  system.b = Eigen::VectorXd::LinSpaced(size, -1, 1);
  return system;
}

const System& system_of(const benchmark::State& state) {
  static std::map<std::int64_t, System> cache;
  const auto [entry, is_new] = cache.try_emplace(state.range(0));
  if (is_new) entry->second = make_system(static_cast<std::size_t>(state.range(0)));
  return entry->second;
}

void cholesky_factor(benchmark::State& state) {
  const System& system = system_of(state);
  for (auto _ : state) benchmark::DoNotOptimize(solver::Cholesky::factor(system.A, system.positions));
}

void cholesky_solve_single(benchmark::State& state) {
  const System& system = system_of(state);
  set_thread_count(static_cast<int>(state.range(1)));
  const auto factor = solver::Cholesky::factor(system.A, system.positions);
  solver::Cholesky::Workspace workspace = factor->make_workspace();
  const Eigen::VectorXf b = system.b.cast<float>();
  Eigen::VectorXf x(b.size());
  const auto n = static_cast<std::size_t>(b.size());
  for (auto _ : state)
    factor->solve(std::span<const float>(b.data(), n), std::span<float>(x.data(), n), workspace);
  state.counters["bytes_per_unknown"] = static_cast<double>(factor->memory()) / static_cast<double>(n);
  set_thread_count(0);
}

void cholesky_solve_double(benchmark::State& state) {
  const System& system = system_of(state);
  const auto factor = solver::Cholesky::factor(system.A, system.positions);
  solver::Cholesky::Workspace workspace = factor->make_workspace();
  Eigen::VectorXd x(system.b.size());
  const auto n = static_cast<std::size_t>(x.size());
  for (auto _ : state)
    factor->solve(std::span<const double>(system.b.data(), n), std::span<double>(x.data(), n), workspace);
}

void by_size(benchmark::internal::Benchmark* b) {
  b->Arg(50000)->Arg(150000)->Arg(316000)->Arg(450000)->Unit(benchmark::kMillisecond)->UseRealTime();
}
void by_size_and_threads(benchmark::internal::Benchmark* b) {
  for (const std::int64_t n : {50000, 150000, 316000, 450000}) b->Args({n, 1})->Args({n, 2});
  b->Unit(benchmark::kMillisecond)->UseRealTime();
}

BENCHMARK(cholesky_factor)->Apply(by_size);
BENCHMARK(cholesky_solve_single)->Apply(by_size_and_threads);
BENCHMARK(cholesky_solve_double)->Apply(by_size);

}  // namespace
}  // namespace relievo
