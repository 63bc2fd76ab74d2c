#include "geometry/image_filters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <utility>

#include "core/simd.h"
#include "relievo/core/parallel.h"

namespace relievo {
namespace {

constexpr int block = 32;  // number of samples computed together, in registers
constexpr float least = -std::numeric_limits<float>::infinity();

// The image with a frame of -infinity around it, so that windows can be read without bounds checks.
struct Framed {
  int frame, stride, rows;
  std::vector<float> values;
  // Largest value of each run of `block` samples within a row.
  int runs;
  std::vector<float> highest;
  // Largest value of each square of `block` x `block` samples.
  std::vector<float> highest_of_square;

  Framed(const Image<float>& image, int frame_width)
      : frame(frame_width),
        stride((image.width + 2 * frame + 2 * block - 1) / block * block),
        rows(image.height + 2 * frame),
        values(static_cast<std::size_t>(stride) * static_cast<std::size_t>(rows), least),
        runs(stride / block),
        highest(static_cast<std::size_t>(runs) * static_cast<std::size_t>(rows), least) {
    parallel_for(
        static_cast<std::size_t>(image.height),
        [&](std::size_t y) {
          const std::size_t row = y + static_cast<std::size_t>(frame);
          for (int x = 0; x < image.width; ++x) {
            const float value = image.at(x, static_cast<int>(y));
            if (!(value > least)) continue;
            const auto place = static_cast<std::size_t>(x + frame);
            values[row * static_cast<std::size_t>(stride) + place] = value;
            float& most = highest[row * static_cast<std::size_t>(runs) + place / block];
            most = std::max(most, value);
          }
        },
        16);
    find_squares();
  }

  void find_squares() {
    highest_of_square.assign(static_cast<std::size_t>(runs) * static_cast<std::size_t>(rows / block + 1),
                             least);
    for (int y = 0; y < rows; ++y)
      for (int run = 0; run < runs; ++run) {
        float& most = highest_of_square[static_cast<std::size_t>(y / block * runs + run)];
        most = std::max(most, highest[static_cast<std::size_t>(y * runs + run)]);
      }
  }

  // Returns an upper bound of the values in rows y - away to y + away and columns x - away to x + away + block - 1.
  float highest_around(int x, int y, int away) const {
    float most = least;
    for (int row = (y - away) / block; row <= (y + away) / block; ++row)
      for (int run = (x - away) / block; run <= (x + block - 1 + away) / block; ++run)
        most = std::max(most, highest_of_square[static_cast<std::size_t>(row * runs + run)]);
    return most;
  }

  const float* at(int x, int y) const { return values.data() + std::ptrdiff_t{y} * stride + x; }

  // Returns an upper bound of the values in row y and columns x to x + count - 1.
  float highest_of(int x, int count, int y) const {
    const float* const row = highest.data() + std::ptrdiff_t{y} * runs;
    return *std::max_element(row + x / block, row + (x + count - 1) / block + 1);
  }
};

struct Sums {
  Float8 v[block / 8];
};

RELIEVO_INLINE void take(Sums& sums, const float* from, float height) {
  for (int i = 0; i < block / 8; ++i) {
    const Float8 value = *reinterpret_cast<const Float8*>(from + 8 * i) - height;
    sums.v[i] = value > sums.v[i] ? value : sums.v[i];
  }
}

RELIEVO_INLINE float lowest_of(const Sums& sums) {
  float lowest = sums.v[0][0];
  for (const Float8& v : sums.v)
    for (int i = 0; i < 8; ++i) lowest = v[i] < lowest ? v[i] : lowest;
  return lowest;
}

// A row of the window around a block. The row is `away` rows from the window's middle, and extends beyond the
// block by `width` on both sides.
struct WindowRow {
  int x, y, away, width;
};

// `lowest` is the smallest of the maxima found so far for the samples of the block. Returns the largest
// horizontal distance from the block at which a value of the row, minus the height of the shape there, can
// exceed `lowest`; -1 if no value can.
RELIEVO_INLINE int reaching(const Framed& from, const Profile& profile, WindowRow row, float lowest) {
  for (;;) {
    const float highest = from.highest_of(row.x - row.width, block + 2 * row.width, row.y);
    int width = row.width;
    while (width >= 0 && highest - profile.at(width, row.away) <= lowest) --width;
    if (width == row.width || width < 0) return width;
    row.width = width;
  }
}

// Does the same as reaching() for the vertical distance from the block, in rows.
RELIEVO_INLINE int rows_reaching(const Framed& from, const Profile& profile, int x, int y, float lowest) {
  int away = profile.reach();
  while (!(profile.at(0, away) < std::numeric_limits<float>::infinity())) --away;
  for (;;) {
    const float highest = from.highest_around(x, y, away);
    int nearer = away;
    while (nearer >= 0 && highest - profile.at(0, nearer) <= lowest) --nearer;
    if (nearer == away || nearer < 0) return nearer;
    away = nearer;
  }
}

RELIEVO_INLINE void take_row(const Framed& from, const Profile& profile, WindowRow row, Sums& sums) {
  while (!(profile.at(row.width, row.away) < std::numeric_limits<float>::infinity())) --row.width;
  const int width = reaching(from, profile, row, lowest_of(sums));
  const float* const middle = from.at(row.x, row.y);
  for (int dx = -width; dx <= width; ++dx) take(sums, middle + dx, profile.at(std::abs(dx), row.away));
}

// Computes the block of samples that begins at x, y of the framed image. Begins with the middle row of the window.
// The maxima found there limit the distance at which a larger value can lie, so rows and columns beyond this distance
// are skipped.
RELIEVO_INLINE void envelope(const Framed& from, const Profile& profile, int x, int y, float* to) {
  Sums sums;
  for (Float8& v : sums.v) v = Float8{} + least;
  take_row(from, profile, {x, y, 0, profile.reach()}, sums);
  const int rows = rows_reaching(from, profile, x, y, lowest_of(sums));
  for (int away = 1; away <= rows; ++away) {
    take_row(from, profile, {x, y - away, away, profile.reach()}, sums);
    take_row(from, profile, {x, y + away, away, profile.reach()}, sums);
  }
  std::memcpy(to, &sums, sizeof sums);
}

// Returns, for each y from 0 to the shape's reach, the greatest x at which the shape's height is finite; -1
// if there is none. Returns an empty list if a finite height of the shape is not 0.
std::vector<int> widths_if_flat(const Profile& profile) {
  std::vector<int> widths(static_cast<std::size_t>(profile.reach()) + 1, -1);
  for (int y = 0; y <= profile.reach(); ++y)
    for (int x = 0; x <= profile.reach(); ++x) {
      const float height = profile.at(x, y);
      if (height < std::numeric_limits<float>::infinity()) widths[static_cast<std::size_t>(y)] = x;
      if (height < std::numeric_limits<float>::infinity() && height != 0) return {};
    }
  return widths;
}

// Doubles the length of the runs. Before the call, each value is the maximum of `length` values of its row,
// from its own position on.
void double_runs(Framed& runs, std::size_t length) {
  const auto stride = static_cast<std::size_t>(runs.stride);
  parallel_for(
      static_cast<std::size_t>(runs.rows),
      [&](std::size_t y) {
        float* const row = runs.values.data() + y * stride;
        for (std::size_t x = 0; x + length < stride; ++x) row[x] = std::max(row[x], row[x + length]);
      },
      16);
}

// Dilates by a flat shape. The maximum over a row of the shape is the greater maximum of two runs of 2^k
// values that overlap. So the time is proportional to the shape's reach and not to its area.
void dilate_by_runs(Framed runs, const std::vector<int>& widths, int border, Image<float>& out) {
  const int longest = 2 * *std::ranges::max_element(widths) + 1;
  for (int length = 1; length <= longest; length *= 2) {
    if (length > 1) double_runs(runs, static_cast<std::size_t>(length / 2));
    parallel_for(
        static_cast<std::size_t>(out.height),
        [&](std::size_t y) {
          float* const to = &out.at(0, static_cast<int>(y));
          const auto take = [&](int away, int width) {
            const float* const first =
                runs.at(runs.frame - border - width, static_cast<int>(y) + runs.frame - border + away);
            const float* const second = first + (2 * width + 1 - length);
            for (int x = 0; x < out.width; ++x) to[x] = std::max(to[x], std::max(first[x], second[x]));
          };
          for (int away = 0; away < static_cast<int>(widths.size()); ++away) {
            const int width = widths[static_cast<std::size_t>(away)];
            if (2 * width + 1 < length || 2 * width + 1 >= 2 * length) continue;
            take(away, width), take(-away, width);
          }
        },
        4);
  }
}

// The number of rows or columns that are averaged at the same time, independently of each other. Neighbouring
// columns are side by side in memory, so that each access to memory uses a whole cache line.
constexpr std::size_t lanes = 16;
using Lanes = std::array<float, lanes>;

// Up to `lanes` lines of n values for a box average. `step` is the distance between the values of a line.
// `line_step` is the distance between lines.
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
  // The sums are doubles, so that values that left the box leave no visible rounding errors.
  std::array<double, lanes> sum{};
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

Image<float> dilate(const Image<float>& image, const Profile& profile, int border) {
  const int width = image.width + 2 * border, height = image.height + 2 * border;
  if (width <= 0 || height <= 0) return {};
  Image<float> out = filled_image(width, height, least);
  Framed from(image, std::max(border, 0) + profile.reach() + block);
  if (const std::vector<int> widths = widths_if_flat(profile); !widths.empty()) {
    dilate_by_runs(std::move(from), widths, border, out);
    return out;
  }
  parallel_for(
      static_cast<std::size_t>(out.height),
      [&](std::size_t row) {
        float result[block];
        for (int x = 0; x < out.width; x += block) {
          RELIEVO_WIDE(envelope(from, profile, x - border + from.frame,
                                static_cast<int>(row) - border + from.frame, result));
          const int count = std::min(block, out.width - x);
          std::copy_n(result, count, &out.at(x, static_cast<int>(row)));
        }
      },
      4);
  return out;
}

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
