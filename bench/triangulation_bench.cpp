#include "relievo/geometry/triangulation.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <random>

namespace relievo {
namespace {

double uniform(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1p-53;
}

std::vector<Vec2> random_points(std::int64_t n) {
  std::mt19937_64 random(1);
  std::vector<Vec2> points;
  for (std::int64_t i = 0; i < n; ++i) points.emplace_back(uniform(random), uniform(random));
  return points;
}

// A square grid of about n points, moved by up to `jitter` of a cell: what a range scanner delivers.
std::vector<Vec2> grid(std::int64_t n, double jitter) {
  std::mt19937_64 random(1);
  const auto side = static_cast<int>(std::sqrt(static_cast<double>(n)));
  std::vector<Vec2> points;
  for (int i = 0; i < side * side; ++i) {
    const Vec2 shift(uniform(random), uniform(random));
    points.push_back((Vec2(i % side, i / side) + jitter * shift) * 0.1);
  }
  return points;
}

std::vector<Vec2> jittered_grid(std::int64_t n) {
  return grid(n, 0.5);
}
std::vector<Vec2> regular_grid(std::int64_t n) {
  return grid(n, 0);
}

std::vector<Vec2> circle(std::int64_t n) {
  std::vector<Vec2> points;
  for (std::int64_t i = 0; i < n; ++i) {
    const double angle = 2 * M_PI * static_cast<double>(i) / static_cast<double>(n);
    points.emplace_back(std::cos(angle), std::sin(angle));
  }
  return points;
}

std::vector<Vec2> parabola(std::int64_t n) {
  std::vector<Vec2> points;
  for (std::int64_t i = 0; i < n; ++i) {
    const auto x = static_cast<double>(i);
    points.emplace_back(x, x * x);
  }
  return points;
}

std::vector<Vec2> two_lines(std::int64_t n) {
  std::vector<Vec2> points;
  for (std::int64_t i = 0; i < n; ++i)
    points.emplace_back(static_cast<double>(i / 2), 1000.0 * static_cast<double>(i % 2));
  return points;
}

// Half of the points evenly, half in clusters of very different sizes.
std::vector<Vec2> clusters(std::int64_t n) {
  std::vector<Vec2> points = random_points(n);
  for (std::size_t i = 0; i < points.size() / 2; ++i)
    points[i] *= std::pow(10.0, -static_cast<double>(i % 16));
  return points;
}

template <std::vector<Vec2> (*make)(std::int64_t)>
void triangulate(benchmark::State& state) {
  const std::vector<Vec2> points = make(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(delaunay(points));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(points.size()));
}

BENCHMARK(triangulate<random_points>)->Unit(benchmark::kMillisecond)->Arg(100000)->Arg(340000)->Arg(1000000);
BENCHMARK(triangulate<jittered_grid>)->Unit(benchmark::kMillisecond)->Arg(340000);
BENCHMARK(triangulate<regular_grid>)->Unit(benchmark::kMillisecond)->Arg(340000);
BENCHMARK(triangulate<circle>)->Unit(benchmark::kMillisecond)->Arg(100000);
BENCHMARK(triangulate<parabola>)->Unit(benchmark::kMillisecond)->Arg(100000);
BENCHMARK(triangulate<two_lines>)->Unit(benchmark::kMillisecond)->Arg(100000);
BENCHMARK(triangulate<clusters>)->Unit(benchmark::kMillisecond)->Arg(340000);

}  // namespace
}  // namespace relievo
