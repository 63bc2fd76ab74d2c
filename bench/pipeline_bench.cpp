// Each stage of the pipeline on a generated scan, by number of input points.
#include <benchmark/benchmark.h>

#include <map>

#include "relievo/io/read.h"
#include "relievo/io/write.h"
#include "relievo/make_relief.h"
#include "relievo/relief/heights.h"
#include "relievo/relief/relief.h"
#include "relievo/samples/sample.h"
#include "relievo/scan/scan_file.h"
#include "relievo/scan/surface.h"
#include "scan/jumps.h"

namespace relievo {
namespace {

// The input of each stage, made once per size by the stages before it.
struct Prepared {
  Cloud cloud;
  Spacing spacing;
  std::vector<Index> visible;
  Surface surface;
  std::vector<Vec2> xy;
  std::vector<float> weights;
};

const Prepared& prepared(benchmark::State& state) {
  static std::map<std::int64_t, Prepared> cache;
  const auto [entry, is_new] = cache.try_emplace(state.range(0));
  Prepared& p = entry->second;
  if (is_new) {
    p.cloud = *make_sample(samples()[0].name, {static_cast<std::size_t>(state.range(0))});
    p.spacing = measure_spacing(p.cloud);
    p.visible = visible_points(p.cloud, p.spacing);
    p.surface = *find_surface(p.cloud, {});
    p.xy = in_plane(p.surface.points);
    p.weights = jump_weights(p.surface);
  }
  state.counters["visible"] = static_cast<double>(p.visible.size());
  return p;
}

void spacing(benchmark::State& state) {
  for (const Prepared& p = prepared(state); auto _ : state)
    benchmark::DoNotOptimize(measure_spacing(p.cloud));
}

void visible(benchmark::State& state) {
  for (const Prepared& p = prepared(state); auto _ : state)
    benchmark::DoNotOptimize(visible_points(p.cloud, p.spacing));
}

void curvature(benchmark::State& state) {
  for (const Prepared& p = prepared(state); auto _ : state)
    benchmark::DoNotOptimize(mean_curvature(p.cloud, p.spacing, p.visible));
}

void triangulation(benchmark::State& state) {
  for (const Prepared& p = prepared(state); auto _ : state) benchmark::DoNotOptimize(delaunay(p.xy));
}

void boundary(benchmark::State& state) {
  for (const Prepared& p = prepared(state); auto _ : state)
    benchmark::DoNotOptimize(find_boundary(p.xy, p.surface.triangulation, p.spacing.rho));
}

void factorisation(benchmark::State& state) {
  for (const Prepared& p = prepared(state); auto _ : state)
    benchmark::DoNotOptimize(
        HeightSystem::build(p.xy, p.surface.triangulation, p.surface.boundary, p.weights));
}

void one_relief(benchmark::State& state) {
  const Prepared& p = prepared(state);
  const auto model = ReliefModel::prepare(p.surface);
  for (auto _ : state) benchmark::DoNotOptimize(model->make({{1, .01}, .02}));
}

void height_to_order(benchmark::State& state) {
  const Prepared& p = prepared(state);
  const auto model = ReliefModel::prepare(p.surface);
  const double height = .025 * p.surface.diagonal;
  for (auto _ : state) benchmark::DoNotOptimize(model->make_at_height(height, {{}, .04}, 1));
}

void from_bytes_to_solid(benchmark::State& state) {
  const std::vector<std::byte> bytes = write_ply(prepared(state).cloud);
  ReliefOptions options;
  options.height_mm = 4;
  for (auto _ : state) benchmark::DoNotOptimize(make_relief(read_cloud(bytes, "bench.ply")->cloud, options));
}

void sizes(benchmark::internal::Benchmark* b) {
  b->Arg(100000)->Arg(300000)->Arg(1000000)->Unit(benchmark::kMillisecond)->UseRealTime();
}
BENCHMARK(spacing)->Apply(sizes);
BENCHMARK(visible)->Apply(sizes);
BENCHMARK(curvature)->Apply(sizes);
BENCHMARK(triangulation)->Apply(sizes);
BENCHMARK(boundary)->Apply(sizes);
BENCHMARK(factorisation)->Apply(sizes);
BENCHMARK(one_relief)->Apply(sizes);
BENCHMARK(height_to_order)->Apply(sizes);
BENCHMARK(from_bytes_to_solid)->Apply(sizes);

}  // namespace
}  // namespace relievo
