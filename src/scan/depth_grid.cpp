#include "scan/depth_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "core/quantile.h"

namespace relievo {
namespace {

// The least inverse depth, as a share of the largest. Smaller values are raised to it, because estimators
// return nearly 0 for the sky, whose depth would be unlimited. So no depth is more than 20 times the smallest
// depth.
constexpr double farthest_inverse = .05;
// The slope, 76 degrees, up to which neighbours belong to one surface. Steeper slopes are more often jumps.
constexpr float steepest = 4;
// Noise grows with depth, so it is measured separately in this many equal parts of the pixels, sorted by
// depth.
constexpr std::size_t noise_bins = 8;

// Converts values into heights, which grow towards the viewer, in pixels of the image.
class HeightScale {
 public:
  HeightScale(const DepthImage& image, const DepthOptions& options) : kind_(options.values) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const float v : image.values.pixels)
      if (is_known(v)) low = std::min(low, double{v}), high = std::max(high, double{v});
    const Vec2 shape = image.pixel_shape();
    const double longer = std::max(shape.x() * image.values.width, shape.y() * image.values.height);
    is_log_ = options.camera.has_value() || kind_ == DepthValues::inverse;
    floor_ = kind_ == DepthValues::inverse ? std::max(farthest_inverse * high, 1e-30) : 1e-30;
    // The camera of an estimator's image is not known. Most cameras have a field of view of about 50 degrees,
    // for which the focal length is 1.1 times the image's longer side.
    const double focal = options.camera ? std::sqrt(options.camera->fx * options.camera->fy) : 1.1 * longer;
    scale_ = is_log_ ? focal : high > low ? options.range * longer / (high - low) : 1;
    if (kind_ == DepthValues::depth) scale_ = -scale_;
  }

  bool is_known(float v) const {
    if (kind_ == DepthValues::depth) return std::isfinite(v) && v > 0;
    return std::isfinite(v) && (v >= 0 || kind_ != DepthValues::inverse);
  }
  // See Cloud::units_per_value, in pixels of the image.
  double units_per_value() const { return is_log_ ? 0 : scale_; }
  double height(double v) const { return scale_ * (is_log_ ? std::log(std::max(v, floor_)) : v); }

 private:
  DepthValues kind_;
  bool is_log_ = false;
  double scale_ = 1, floor_ = 0;
};

// The uncertainty of a depth camera's values, in distances between neighbouring values of the image. Such
// cameras write millimetres, but at large depths only about every tenth millimetre occurs. Noise then decides
// which of the two nearest values is written, so the uncertainty is more than half of their distance.
constexpr double sensor_steps = 1.5;

// Estimates the uncertainty of values that their steps cause: at least half a step of the file.
class ValueSteps {
 public:
  explicit ValueSteps(const DepthImage& image) : least_(image.step / 2) {
    if (image.step == 0) return;
    std::map<float, std::size_t> counts;
    for (const float v : image.values.pixels)
      if (std::isfinite(v)) ++counts[v];
    for (const auto& [value, count] : counts)
      if (count >= 3) values_.push_back(value);
  }

  // Returns whether the values come from a depth camera: their steps are then coarser than the file's.
  bool are_sensors() const {
    return values_.size() > 16 && uncertainty(values_[values_.size() / 2]) > 2 * least_;
  }

  double uncertainty(float v) const {
    constexpr std::ptrdiff_t around = 4;
    const auto at = std::ranges::lower_bound(values_, v) - values_.begin();
    std::array<float, 2 * around> gaps = {};
    std::size_t n = 0;
    const auto size = static_cast<std::ptrdiff_t>(values_.size());
    for (std::ptrdiff_t i = std::max<std::ptrdiff_t>(1, at - around + 1); i < std::min(size, at + around + 1);
         ++i)
      gaps[n++] = values_[static_cast<std::size_t>(i)] - values_[static_cast<std::size_t>(i - 1)];
    if (n < 3) return least_;
    const double gap = double{median(std::span(gaps).first(n))}, most = .02 * std::abs(double{v});
    return gap > 2 * least_ ? std::max(least_, std::min(most, sensor_steps * gap)) : least_;
  }

 private:
  double least_;
  std::vector<float> values_;  // the values that occur at least three times, ascending
};

// The standard deviation of the heights' noise, by depth. It is measured by the twist a - b - c + d of 2 x 2
// blocks, which is 0 on planes and nearly 0 on curved surfaces without noise.
struct Noise {
  std::array<float, noise_bins> limit;  // highest height of each bin
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
    noise.sigma[bin] = 1.4826F * median(sizes) / 2;  // 1.4826: median to deviation; / 2: sum of four heights
  }
  return noise;
}

// Extends the bounds of every grid point to the median around it, because single values of a depth camera may
// be far off.
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

// Widens the bounds to two standard deviations of the noise.
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

// The mean of a square block of pixels, which becomes one grid point. Only pixels near the median count, so
// that a block on an outline represents one of its two sides and not their mean.
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

DepthGrid make_grid(const DepthImage& image, const DepthOptions& options) {
  const HeightScale scale(image, options);
  const ValueSteps steps(image);
  const int k = reduction_for(image, options.points);
  DepthGrid grid;
  grid.reduction = k;
  grid.units_per_value = scale.units_per_value() / k;
  BoundedGrid& b = grid.bounds;
  b.width = image.values.width / k, b.height = image.values.height / k;
  const std::size_t n = b.at(0, b.height);
  for (auto* values : {&b.low, &b.high, &grid.height}) values->assign(n, 0);
  for (auto* flags : {&b.is_known, &b.joins_right, &b.joins_down}) flags->assign(n, 0);
  for (const float v : image.values.pixels) grid.missing += !scale.is_known(v);
  std::vector<Block> pixels;
  for (int r = 0; r < b.height; ++r)
    for (int c = 0; c < b.width; ++c) {
      pixels.clear();
      for (int y = r * k; y < (r + 1) * k; ++y)
        for (int x = c * k; x < (c + 1) * k; ++x) {
          const float v = image.values.at(x, y);
          if (!scale.is_known(v)) continue;
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
  if (grid.is_sensor) allow_specks(grid);
  return grid;
}

void join(DepthGrid& grid) {
  BoundedGrid& b = grid.bounds;
  // A difference is a jump if the neighbours' bounds do not explain it. The bounds of depth cameras are
  // several times as wide as the differences on a surface, so there a smaller part of the bounds is the
  // limit.
  const float jump = grid.is_sensor ? .45F : 1.8F;
  const auto is_near = [&](std::size_t i, std::size_t j) {
    if (!b.is_known[i] || !b.is_known[j]) return false;
    const float open = (b.high[i] - b.low[i]) + (b.high[j] - b.low[j]);
    return std::abs(grid.height[i] - grid.height[j]) <= std::max(steepest, jump * open);
  };
  for (int r = 0; r < b.height; ++r)
    for (int c = 0; c < b.width; ++c) {
      const std::size_t i = b.at(c, r);
      b.joins_right[i] = c + 1 < b.width && is_near(i, i + 1);
      b.joins_down[i] = r + 1 < b.height && is_near(i, i + static_cast<std::size_t>(b.width));
    }
}

std::size_t cut_ramps(DepthGrid& grid) {
  BoundedGrid& b = grid.bounds;
  const auto width = static_cast<std::ptrdiff_t>(b.width);
  std::size_t cut = 0;
  const int passes = 6;  // each removes a pixel from both ends of a ramp, so ramps may be 12 pixels wide
  for (int pass = 0; pass < passes; ++pass) {
    std::vector<std::size_t> ramps;
    for (int r = 0; r < b.height; ++r)
      for (int c = 0; c < b.width; ++c) {
        const std::size_t i = b.at(c, r);
        if (!b.is_known[i]) continue;
        // On a ramp the heights before and after the grid point differ steeply from its own, in the same
        // direction, and the grid point is not joined to both neighbours.
        const auto is_ramp_along = [&](std::ptrdiff_t step, bool has_both, bool joins_before,
                                       bool joins_after) {
          if (!has_both || (joins_before && joins_after)) return false;
          const std::size_t before = i - static_cast<std::size_t>(step),
                            after = i + static_cast<std::size_t>(step);
          if (!b.is_known[before] || !b.is_known[after]) return false;
          const float up = grid.height[i] - grid.height[before], on = grid.height[after] - grid.height[i];
          return up * on > 0 && std::min(std::abs(up), std::abs(on)) > steepest / 2;
        };
        const bool has_columns = c > 0 && c + 1 < b.width, has_rows = r > 0 && r + 1 < b.height;
        if (is_ramp_along(1, has_columns, has_columns && b.joins_right[i - 1], b.joins_right[i]) ||
            is_ramp_along(width, has_rows, has_rows && b.joins_down[i - static_cast<std::size_t>(width)],
                          b.joins_down[i]))
          ramps.push_back(i);
      }
    for (const std::size_t i : ramps) b.is_known[i] = 0;
    cut += ramps.size();
    if (ramps.empty()) break;
    join(grid);
  }
  return cut;
}

std::size_t remove_background(DepthGrid& grid) {
  BoundedGrid& b = grid.bounds;
  std::vector<float> heights;
  for (std::size_t i = 0; i < grid.height.size(); ++i)
    if (b.is_known[i]) heights.push_back(grid.height[i]);
  if (heights.size() < 16) return 0;
  std::ranges::sort(heights);
  // Otsu's method: the threshold that leaves the least variance within both groups, hence the most between
  // them.
  double sum = 0, total = 0, total_sq = 0;
  for (const float h : heights) total += double{h}, total_sq += double{h} * double{h};
  const auto n = static_cast<double>(heights.size());
  double best = 0;
  std::size_t split = 0;
  for (std::size_t i = 1; i < heights.size(); ++i) {
    sum += double{heights[i - 1]};
    const auto k = static_cast<double>(i);
    const double gap = sum / k - (total - sum) / (n - k), between = k * (n - k) * gap * gap / (n * n);
    if (between > best && heights[i] > heights[i - 1]) best = between, split = i;
  }
  const double variance = total_sq / n - total / n * (total / n);
  // Less than 70 % of the variance between the groups means that there is no clear gap.
  if (split == 0 || best < .7 * variance) return 0;
  const float threshold = (heights[split] + heights[split - 1]) / 2;
  std::size_t border = 0, far_border = 0;
  const auto look = [&](int c, int r) {
    const std::size_t i = b.at(c, r);
    border += 1;
    far_border += !b.is_known[i] || grid.height[i] < threshold;
  };
  for (int c = 0; c < b.width; ++c) look(c, 0), look(c, b.height - 1);
  for (int r = 0; r < b.height; ++r) look(0, r), look(b.width - 1, r);
  // A background covers at least 60 % of the border; otherwise the front extends beyond the image.
  if (10 * far_border < 6 * border) return 0;
  for (std::size_t i = 0; i < grid.height.size(); ++i)
    if (grid.height[i] < threshold) b.is_known[i] = 0;
  return split;
}

}  // namespace relievo
