#include <benchmark/benchmark.h>

#include <string>

#include "relievo/samples/sample.h"

namespace relievo {
namespace {

void make_each_sample(benchmark::State& state) {
  const SampleInfo& info = samples()[static_cast<std::size_t>(state.range(0))];
  const auto points = static_cast<std::size_t>(state.range(1));
  for (auto _ : state) benchmark::DoNotOptimize(make_sample(info.name, {points, 0.15}));
  state.SetLabel(std::string(info.name));
  state.SetItemsProcessed(state.iterations() * state.range(1));
}
BENCHMARK(make_each_sample)
    ->ArgsProduct({{0, 1, 2}, {300000, 1000000}})
    ->ArgNames({"sample", "points"})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Iterations(1);

}  // namespace
}  // namespace relievo
