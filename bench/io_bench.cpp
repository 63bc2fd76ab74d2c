// Reading a generated cloud with normals: binary PLY, ascii PLY and XYZ text.
#include "relievo/io/read.h"
#include "relievo/io/write.h"

#include <benchmark/benchmark.h>

#include <charconv>
#include <cmath>
#include <string>

namespace relievo {
namespace {

Cloud make_sphere(std::size_t points) {
  Cloud cloud;
  for (std::size_t i = 0; i < points; ++i) {
    const double z = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(points);
    const double angle = 2.399963229728653 * static_cast<double>(i), r = std::sqrt(1 - z * z);
    const Vec3 normal(r * std::cos(angle), r * std::sin(angle), z);
    cloud.points.push_back(100 * normal);
    cloud.normals.push_back(normal.cast<float>());
  }
  return cloud;
}

std::string as_text(const Cloud& cloud) {
  std::string text;
  std::array<char, 32> digits;
  const auto put = [&](float value, char end) {
    text.append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr);
    text += end;
  };
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    for (const double value : cloud.points[i]) put(static_cast<float>(value), ' ');
    for (int c = 0; c < 3; ++c) put(cloud.normals[i][c], c < 2 ? ' ' : '\n');
  }
  return text;
}

std::string ascii_header(std::size_t points) {
  std::string header = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(points) + "\n";
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz"})
    header += std::string("property float ") + name + "\n";
  return header + "end_header\n";
}

void read(benchmark::State& state, std::span<const std::byte> bytes) {
  for (auto _ : state) {
    auto file = read_cloud(bytes, "bench");
    if (!file) state.SkipWithError(file.error().message().c_str());
    benchmark::DoNotOptimize(file);
  }
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(bytes.size()));
}

void read_binary_ply(benchmark::State& state) {
  read(state, write_ply(make_sphere(static_cast<std::size_t>(state.range(0)))));
}

void read_ascii_ply(benchmark::State& state) {
  const auto points = static_cast<std::size_t>(state.range(0));
  const std::string text = ascii_header(points) + as_text(make_sphere(points));
  read(state, std::as_bytes(std::span(text)));
}

void read_xyz(benchmark::State& state) {
  const std::string text = as_text(make_sphere(static_cast<std::size_t>(state.range(0))));
  read(state, std::as_bytes(std::span(text)));
}

BENCHMARK(read_binary_ply)->Arg(100000)->Arg(1000000)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(read_ascii_ply)->Arg(100000)->Arg(1000000)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(read_xyz)->Arg(100000)->Arg(1000000)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace relievo
