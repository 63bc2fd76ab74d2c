// The last stages on a front of 700k triangles: plate, files, height map, preview.
#include <benchmark/benchmark.h>

#include <cmath>

#include "relievo/io/write.h"
#include "relievo/picture/height_map.h"
#include "relievo/picture/preview.h"
#include "relievo/plate/solid.h"
#include "relievo/scan/surface.h"

namespace relievo {
namespace {

constexpr int cells = 592;

// A round relief of waves on a square of 150 mm.
double height_mm(double x, double y) {
  const double r = std::hypot(x - 75, y - 75) / 70;
  return r < 1 ? 4 * (1 - r * r) * (1.2 + std::sin(x / 2) * std::sin(y / 3) + 0.3 * std::sin(3 * x)) : 0;
}

HeightFieldMesh front() {
  HeightFieldMesh front;
  const auto at = [](int i, int j) { return static_cast<Index>(j * (cells + 1) + i); };
  for (int j = 0; j <= cells; ++j)
    for (int i = 0; i <= cells; ++i) {
      const double x = 150.0 * i / cells, y = 150.0 * j / cells;
      front.points.emplace_back(x, y, height_mm(x, y));
    }
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      front.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      front.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  for (int i = 0; i < cells; ++i) front.hull.push_back(at(i, 0));
  for (int i = 0; i < cells; ++i) front.hull.push_back(at(cells, i));
  for (int i = cells; i > 0; --i) front.hull.push_back(at(i, cells));
  for (int i = cells; i > 0; --i) front.hull.push_back(at(0, i));
  return front;
}

const Solid& plate() {
  static const Solid solid = make_plate(front(), {}).value();
  return solid;
}

template <typename F>
void run(benchmark::State& state, F&& f) {
  for (auto _ : state) benchmark::DoNotOptimize(f());
}

void make_plate_700k(benchmark::State& state) {
  const HeightFieldMesh relief = front();
  run(state, [&] { return make_plate(relief, {}); });
}
void check_solid_700k(benchmark::State& state) {
  run(state, [solid = plate()] { return check_solid(solid); });
}
void write_stl_700k(benchmark::State& state) {
  run(state, [solid = plate()] { return write_stl(solid); });
}
void write_ply_700k(benchmark::State& state) {
  run(state, [solid = plate()] { return write_ply(solid); });
}
void write_obj_700k(benchmark::State& state) {
  run(state, [solid = plate()] { return write_obj(solid); });
}
void make_height_map_1200(benchmark::State& state) {
  run(state, [solid = plate()] { return make_height_map(solid, 1200); });
}
void render_preview_1200(benchmark::State& state) {
  run(state, [solid = plate()] { return render_preview(solid, {}); });
}
void write_png_preview(benchmark::State& state) {
  run(state, [image = render_preview(plate(), {})] { return write_png(image); });
}
void write_png_height_map(benchmark::State& state) {
  run(state, [map = make_height_map(plate(), 1200)] { return write_png(map.image); });
}

BENCHMARK(make_plate_700k)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(check_solid_700k)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(write_stl_700k)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(write_ply_700k)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(write_obj_700k)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(make_height_map_1200)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(render_preview_1200)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(write_png_preview)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(write_png_height_map)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace relievo
