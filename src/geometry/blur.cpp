#include "geometry/blur.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "relievo/core/parallel.h"

namespace relievo {
namespace {

// The number of lines that are averaged together. They are side by side in memory, so that columns use whole
// cache lines.
constexpr std::size_t lanes = 16;
using Lanes = std::array<float, lanes>;

// Up to `lanes` lines of n values for a box average. `step` is the distance between values, `line_step` the
// one between lines.
struct Strip {
  float* values;
  std::size_t n, step, lines, line_step;

  Lanes load(std::size_t i) const {
    Lanes lane{};
    for (std::size_t l = 0; l < lines; ++l) lane[l] = values[i * step + l * line_step];
    return lane;
  }
  void store(std::size_t i, const Lanes& lane) const {
    for (std::size_t l = 0; l < lines; ++l) values[i * step + l * line_step] = lane[l];
  }
};

void average(const Strip& strip, std::size_t radius, std::vector<Lanes>& line) {
  line.resize(strip.n);
  for (std::size_t i = 0; i < strip.n; ++i) line[i] = strip.load(i);
  std::array<double, lanes> sum{};  // double, so that values which leave the box leave no trace
  const auto last = static_cast<std::ptrdiff_t>(strip.n) - 1, r = static_cast<std::ptrdiff_t>(radius);
  const auto add = [&](std::ptrdiff_t i, double sign) {
    const Lanes& lane = line[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i, 0, last))];
    for (std::size_t l = 0; l < lanes; ++l) sum[l] += sign * lane[l];
  };
  for (std::ptrdiff_t i = -r - 1; i < r; ++i) add(i, 1);
  const double scale = 1.0 / static_cast<double>(2 * r + 1);
  for (std::ptrdiff_t i = 0; i <= last; ++i) {
    add(i + r, 1);
    add(i - r - 1, -1);
    Lanes mean;
    for (std::size_t l = 0; l < lanes; ++l) mean[l] = static_cast<float>(sum[l] * scale);
    strip.store(static_cast<std::size_t>(i), mean);
  }
}

}  // namespace

void blur(Image<float>& image, int radius) {
  const auto w = static_cast<std::size_t>(image.width), h = static_cast<std::size_t>(image.height),
             r = static_cast<std::size_t>(radius);
  float* const values = image.pixels.data();
  const int passes = 2;
  for (int pass = 0; pass < passes; ++pass) {
    parallel_ranges(h, lanes, [&](std::size_t begin, std::size_t end) {
      std::vector<Lanes> line;
      average({&values[begin * w], w, 1, end - begin, w}, r, line);
    });
    parallel_ranges(w, lanes, [&](std::size_t begin, std::size_t end) {
      std::vector<Lanes> line;
      average({&values[begin], h, w, end - begin, 1}, r, line);
    });
  }
}

}  // namespace relievo
