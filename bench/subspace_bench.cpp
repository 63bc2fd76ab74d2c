// The subspace mode: preparation, and the parts of a frame, for a front of about 450,000 points.
#include <benchmark/benchmark.h>

#include <limits>

#include "relievo/relief/relief.h"
#include "relievo/relief/subspace.h"
#include "relievo/samples/sample.h"
#include "relievo/scan/surface.h"

namespace relievo {
namespace {

struct Prepared {
  Surface surface;
  std::vector<double> reference;
  SubspaceModel model;
};

const Prepared& prepared() {
  static const Prepared it = [] {
    Surface surface = *find_surface(*make_sample("shell", {1'130'000}), {});
    constexpr double keep_all = std::numeric_limits<double>::infinity();
    std::vector<double> z0 = ReliefModel::prepare(surface)->make({{keep_all, 0}}).heights;
    SubspaceModel model = *SubspaceModel::prepare(surface, {}, {z0, {}});
    return Prepared{std::move(surface), std::move(z0), std::move(model)};
  }();
  return it;
}

void subspace_prepare(benchmark::State& state) {
  const Prepared& p = prepared();
  for (auto _ : state) benchmark::DoNotOptimize(SubspaceModel::prepare(p.surface, {}, {p.reference, {}}));
}
BENCHMARK(subspace_prepare)->Unit(benchmark::kMillisecond)->UseRealTime();

// By saturation, in hundredths.
void subspace_heights(benchmark::State& state) {
  const SubspaceModel& model = prepared().model;
  SubspaceModel::Workspace workspace = model.make_workspace();
  std::vector<float> heights(model.size());
  const Shape shape{{1, static_cast<double>(state.range(0)) / 100}};
  const Surface& surface = prepared().surface;
  const std::vector<float> weight = boundary_weights(surface.boundary.distance, surface.rho);
  for (auto _ : state) {
    model.solve(shape, weight, workspace);
    model.carry(weight, workspace, heights);
  }
  state.counters["points"] = static_cast<double>(model.size());
  state.counters["control_points"] = static_cast<double>(model.control_points().points.size());
}
BENCHMARK(subspace_heights)->Arg(0)->Arg(100)->Unit(benchmark::kMillisecond)->UseRealTime();

// The reference heights of the control points, carried to all points.
struct Carried {
  std::vector<Vec2> sites, points;
  std::vector<float> values;
  MultilevelSpline spline;
};

Carried carried(const Prepared& p) {
  Carried it;
  SplineOptions options;
  for (const Vec3& point : p.surface.points) {
    it.points.push_back(point.head<2>());
    options.min = options.min.cwiseMin(it.points.back());
    options.max = options.max.cwiseMax(it.points.back());
  }
  for (const Index i : p.model.control_points().points) {
    it.sites.push_back(it.points[i]);
    it.values.push_back(static_cast<float>(p.reference[i]));
  }
  options.cell = .75 * p.model.control_points().radius;
  it.spline = MultilevelSpline(it.sites, std::vector<float>(it.sites.size(), 1.F), options);
  return it;
}

void spline_fit(benchmark::State& state) {
  const Carried it = carried(prepared());
  SplineFunction function = it.spline.make_function();
  MultilevelSpline::Workspace workspace = it.spline.make_workspace();
  for (auto _ : state) it.spline.fit(it.values, function, workspace);
}
BENCHMARK(spline_fit)->Unit(benchmark::kMillisecond)->UseRealTime();

void spline_evaluate(benchmark::State& state) {
  const Carried it = carried(prepared());
  const SplineFunction function = it.spline.make_function();
  const std::vector<SplinePlace> places = it.spline.pack(it.points);
  std::vector<float> values(places.size());
  for (auto _ : state) it.spline.evaluate(function, places, values);
}
BENCHMARK(spline_evaluate)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace relievo
