#include "scan/depth/depth_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "core/quantile.h"

namespace relievo {
namespace {

// Neighbours belong to one surface if the slope between them is at most this, 76 degrees. Steeper slopes are
// usually jumps.
constexpr float steepest = 4;
// Noise grows with depth. So the pixels are sorted by depth and divided into this many equal bins, and the
// noise is measured in each bin separately.
constexpr std::size_t noise_bins = 8;

// The standard deviation of the heights' noise, by depth. It is measured from the twist a - b - c + d of the heights
// in 2 x 2 blocks, which without noise is 0 on planes and nearly 0 on curved surfaces.
struct Noise {
  std::array<float, noise_bins> limit;  // largest height of each bin
  std::array<float, noise_bins> sigma;

  float at(float height) const {
    std::size_t bin = 0;
    while (bin + 1 < noise_bins && height > limit[bin]) ++bin;
    return sigma[bin];
  }
};

Noise measure_noise(const DepthGrid& grid) {
  const BoundedGrid& b = grid.bounds;
  struct Twist {
    float height, twist;
  };
  std::vector<Twist> twists;
  for (int r = 0; r + 1 < b.height; ++r)
    for (int c = 0; c + 1 < b.width; ++c) {
      const std::size_t p = b.at(c, r), q = b.at(c + 1, r), s = b.at(c, r + 1), t = b.at(c + 1, r + 1);
      if (!b.is_known[p] || !b.is_known[q] || !b.is_known[s] || !b.is_known[t]) continue;
      twists.push_back(
          {grid.height[p], std::abs(grid.height[p] - grid.height[q] - grid.height[s] + grid.height[t])});
    }
  Noise noise{};
  noise.limit.fill(std::numeric_limits<float>::infinity());
  if (twists.size() < 64 * noise_bins) return noise;
  std::ranges::sort(twists, {}, &Twist::height);
  for (std::size_t bin = 0; bin < noise_bins; ++bin) {
    const auto first = twists.begin() + static_cast<std::ptrdiff_t>(bin * twists.size() / noise_bins);
    const auto last = twists.begin() + static_cast<std::ptrdiff_t>((bin + 1) * twists.size() / noise_bins);
    noise.limit[bin] = (last - 1)->height;
    std::vector<float> sizes;
    for (auto it = first; it != last; ++it) sizes.push_back(it->twist);
    // The factor 1.4826 turns the median into a standard deviation. A twist is the sum of four heights, so its
    // deviation is twice that of one height.
    noise.sigma[bin] = 1.4826F * median(sizes) / 2;
  }
  return noise;
}

// Extends the bounds of each grid point to include the median of its neighbourhood, because single values of
// a depth camera may be far off.
void allow_specks(DepthGrid& grid) {
  BoundedGrid& b = grid.bounds;
  for (int r = 1; r + 1 < b.height; ++r)
    for (int c = 1; c + 1 < b.width; ++c) {
      const std::size_t i = b.at(c, r);
      std::array<float, 9> around;
      std::size_t n = 0;
      for (int y = r - 1; y <= r + 1; ++y)
        for (int x = c - 1; x <= c + 1; ++x)
          if (b.is_known[b.at(x, y)]) around[n++] = grid.height[b.at(x, y)];
      if (!b.is_known[i] || n < 6) continue;
      const float middle = median(std::span(around).first(n));
      b.low[i] = std::min(b.low[i], middle);
      b.high[i] = std::max(b.high[i], middle);
    }
}

// Widens the bounds of each height so that they are at least two standard deviations of the noise away from
// it.
void allow_noise(DepthGrid& grid) {
  const Noise noise = measure_noise(grid);
  std::vector<float> open;
  for (std::size_t i = 0; i < grid.height.size(); ++i) {
    if (!grid.bounds.is_known[i]) continue;
    const float width = 2 * noise.at(grid.height[i]);
    grid.bounds.low[i] = std::min(grid.bounds.low[i], grid.height[i] - width);
    grid.bounds.high[i] = std::max(grid.bounds.high[i], grid.height[i] + width);
    open.push_back((grid.bounds.high[i] - grid.bounds.low[i]) / 2);
  }
  if (open.empty()) return;
  grid.noise = double{median(open)};
}

// The mean of a square block of pixels, which becomes one grid point. Only pixels close to the median count,
// so a block on an outline represents one of the two surfaces instead of their mean.
struct Block {
  float height = 0, low = 0, high = 0;
};

std::optional<Block> mean_of(std::vector<Block>& pixels, std::size_t all) {
  if (2 * pixels.size() < all) return std::nullopt;
  const auto middle = pixels.begin() + static_cast<std::ptrdiff_t>(pixels.size() / 2);
  std::ranges::nth_element(pixels, middle, {}, &Block::height);
  const float median = middle->height;
  Block sum;
  float n = 0;
  for (const Block& p : pixels) {
    if (std::abs(p.height - median) > steepest * static_cast<float>(std::sqrt(all))) continue;
    sum.height += p.height, sum.low += p.low, sum.high += p.high, ++n;
  }
  return Block{sum.height / n, sum.low / n, sum.high / n};
}

int reduction_for(const DepthImage& image, double points) {
  const double pixels = static_cast<double>(image.values.width) * image.values.height;
  return std::max(1, static_cast<int>(std::lround(std::sqrt(pixels / points))));
}

}  // namespace

GridMaker::GridMaker(const DepthImage& image, const DepthOptions& options)
    : image_(image),
      options_(options),
      valid_(valid_values(image, options.values)),
      reduction_(reduction_for(image, options.points)) {}

// Returns whether the pixel's value is a depth and its grid point is not in the mask.
bool GridMaker::counts(int x, int y, const GridMask& is_left_out) const {
  const int columns = image_.values.width / reduction_, rows = image_.values.height / reduction_;
  if (!valid_.contains(image_.values.at(x, y))) return false;
  const int c = x / reduction_, r = y / reduction_;
  if (is_left_out.empty() || c >= columns || r >= rows) return true;
  return !is_left_out[static_cast<std::size_t>(r) * static_cast<std::size_t>(columns) +
                      static_cast<std::size_t>(c)];
}

// Returns the image with only the values for which counts() is true; the others are missing.
DepthImage GridMaker::counted(const GridMask& is_left_out) const {
  DepthImage image = image_;
  for (int y = 0; y < image.values.height; ++y)
    for (int x = 0; x < image.values.width; ++x)
      if (!counts(x, y, is_left_out)) image.values.at(x, y) = std::numeric_limits<float>::quiet_NaN();
  return image;
}

DepthGrid GridMaker::make(const GridMask& is_left_out) const {
  const DepthImage kept = counted(is_left_out);
  ValueRange range = ValueRange::none();
  for (const float v : kept.values.pixels)
    if (std::isfinite(v)) range.extend(v);
  const HeightScale scale(image_, options_, range);
  const ValueSteps steps(kept);
  const int k = reduction_;
  DepthGrid grid;
  grid.units_per_value = scale.units_per_value() / k;
  BoundedGrid& b = grid.bounds;
  b.width = image_.values.width / k, b.height = image_.values.height / k;
  const std::size_t n = b.at(0, b.height);
  for (auto* values : {&b.low, &b.high, &grid.height}) values->assign(n, 0);
  for (auto* flags : {&b.is_known, &b.joins_right, &b.joins_down}) flags->assign(n, 0);
  std::vector<Block> pixels;
  for (int r = 0; r < b.height; ++r)
    for (int c = 0; c < b.width; ++c) {
      pixels.clear();
      for (int y = r * k; y < (r + 1) * k; ++y)
        for (int x = c * k; x < (c + 1) * k; ++x) {
          const float v = image_.values.at(x, y);
          if (!valid_.contains(v)) continue;
          const double off = steps.uncertainty(v), one = scale.height(double{v} - off),
                       other = scale.height(double{v} + off);
          const auto in_grid = [&](double h) { return static_cast<float>(h / k); };
          pixels.push_back({in_grid(scale.height(double{v})), in_grid(std::min(one, other)),
                            in_grid(std::max(one, other))});
        }
      const auto mean = mean_of(pixels, static_cast<std::size_t>(k) * static_cast<std::size_t>(k));
      if (!mean) continue;
      const std::size_t i = b.at(c, r);
      b.is_known[i] = 1;
      grid.height[i] = mean->height, b.low[i] = mean->low, b.high[i] = mean->high;
    }
  allow_noise(grid);
  grid.is_sensor = steps.are_sensors();
  grid.is_terrain = options_.values == DepthValues::height;
  if (grid.is_sensor) allow_specks(grid);
  return grid;
}

bool DepthGrid::is_near(std::size_t i, std::size_t j) const {
  // A height difference is a jump if the bounds of both points do not explain it. The bounds of depth cameras
  // are several times as wide as differences within a surface, so for them only a part of the bounds is used.
  const float jump = is_sensor ? .45F : 1.8F;
  const float open = (bounds.high[i] - bounds.low[i]) + (bounds.high[j] - bounds.low[j]);
  return std::abs(height[i] - height[j]) <= std::max(steepest, jump * open);
}

bool GridLine::continues(int i, int next) const {
  constexpr float steeper = 2.5F;
  const float here = step(i), there = step(next);
  return here * there > 0 && std::abs(here) <= steeper * std::abs(there);
}

bool GridLine::is_smooth(int i) const {
  if (!has_step(i)) return false;
  if (grid.is_near(at(i), at(i + 1))) return true;
  // For depth cameras, a steep step never counts as the continuation of a slope, because a jump with noise beside it
  // can look like one.
  return !grid.is_sensor && (continues(i, i - 1) || continues(i, i + 1));
}

GridLine row_of(const DepthGrid& grid, int row) {
  return {grid, grid.bounds.at(0, row), 1, grid.bounds.width};
}

GridLine column_of(const DepthGrid& grid, int column) {
  return {grid, grid.bounds.at(column, 0), static_cast<std::size_t>(grid.bounds.width), grid.bounds.height};
}

void join(DepthGrid& grid) {
  BoundedGrid& b = grid.bounds;
  for (int r = 0; r < b.height; ++r)
    for (int c = 0; c < b.width; ++c) {
      const GridLine row = row_of(grid, r), column = column_of(grid, c);
      b.joins_right[b.at(c, r)] = grid.is_terrain ? row.has_step(c) : row.is_smooth(c);
      b.joins_down[b.at(c, r)] = grid.is_terrain ? column.has_step(r) : column.is_smooth(r);
    }
}

}  // namespace relievo
