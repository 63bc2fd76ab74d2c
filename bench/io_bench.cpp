// Reading a generated cloud with normals: binary PLY, ascii PLY and XYZ text; and a mesh from binary STL. Assimp, where it is
// installed, reads the same bytes.
#include "relievo/io/read.h"
#include "relievo/io/write.h"

#include <benchmark/benchmark.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <string>

#ifdef RELIEVO_BENCH_ASSIMP
#include <assimp/Importer.hpp>
#endif

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

// Returns a mesh with half as many vertices as triangles, as closed meshes have.
std::string stl_of(std::size_t triangles) {
  const std::size_t width = 1000;  // vertices from one row of triangles to the next
  const Cloud cloud = make_sphere(triangles / 2 + width + 1);
  std::string file(84, '\0');
  std::memcpy(file.data() + 80, &triangles, 4);
  for (std::size_t t = 0; t < triangles; ++t) {
    const std::size_t a = t / 2, corners[3] = {a + t % 2, a + (t % 2 ? 0 : 1), a + width + t % 2};
    std::array<float, 12> numbers{};
    for (std::size_t k = 3; k < 12; ++k)
      numbers[k] = static_cast<float>(cloud.points[corners[k / 3 - 1]][static_cast<int>(k % 3)]);
    file.append(reinterpret_cast<const char*>(numbers.data()), sizeof numbers).append(2, '\0');
  }
  return file;
}

void read_binary_stl(benchmark::State& state) {
  const std::string file = stl_of(static_cast<std::size_t>(state.range(0)));
  read(state, std::as_bytes(std::span(file)));
}

#ifdef RELIEVO_BENCH_ASSIMP
void read_by_assimp(benchmark::State& state, std::span<const std::byte> bytes, const char* ending) {
  for (auto _ : state) {
    Assimp::Importer importer;
    if (!importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, ending))
      state.SkipWithError(importer.GetErrorString());
  }
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(bytes.size()));
}

void assimp_binary_ply(benchmark::State& state) {
  read_by_assimp(state, write_ply(make_sphere(static_cast<std::size_t>(state.range(0)))), "ply");
}

void assimp_ascii_ply(benchmark::State& state) {
  const auto points = static_cast<std::size_t>(state.range(0));
  const std::string text = ascii_header(points) + as_text(make_sphere(points));
  read_by_assimp(state, std::as_bytes(std::span(text)), "ply");
}

void assimp_binary_stl(benchmark::State& state) {
  const std::string file = stl_of(static_cast<std::size_t>(state.range(0)));
  read_by_assimp(state, std::as_bytes(std::span(file)), "stl");
}

BENCHMARK(assimp_binary_ply)->Arg(1000000)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(assimp_ascii_ply)->Arg(1000000)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(assimp_binary_stl)->Arg(1000000)->Unit(benchmark::kMillisecond)->UseRealTime();
#endif

BENCHMARK(read_binary_stl)->Arg(100000)->Arg(1000000)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(read_binary_ply)->Arg(100000)->Arg(1000000)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(read_ascii_ply)->Arg(100000)->Arg(1000000)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(read_xyz)->Arg(100000)->Arg(1000000)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace relievo
