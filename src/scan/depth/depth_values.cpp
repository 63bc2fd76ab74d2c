#include "scan/depth/depth_grid.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>

#include "core/quantile.h"

namespace relievo {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
// The least inverse depth, as a share of the largest. Estimators return nearly 0 for the sky, whose depth
// would be unlimited. So smaller values are raised to this share, and no depth exceeds 20 times the smallest
// depth.
constexpr double farthest_inverse = .05;
// In files of floating-point numbers, values above this multiple of the nearest depths are not depths. Renderers
// write values such as 1e10 where a ray hits nothing, and mix them with depths along outlines.
constexpr double farthest_depth = 1e5;
// The highest value marks missing depths if its distance from all other values is this many times their range. A
// smaller distance suffices if the highest value is the largest number of an integer type.
constexpr double widest_gap = 100;

struct Extremes {
  double lowest = infinite, second = infinite, last_but_one = -infinite, highest = -infinite;

  void add(double v) {
    if (v < lowest) second = lowest, lowest = v;
    if (v > lowest) second = std::min(second, v);
    if (v > highest) last_but_one = highest, highest = v;
    if (v < highest) last_but_one = std::max(last_but_one, v);
  }
  double gap_below_highest() const { return highest - last_but_one; }
  double range_below_highest() const { return last_but_one - lowest; }
};

Extremes extremes_of(const DepthImage& image, const ValueRange& valid) {
  Extremes found;
  for (const float v : image.values.pixels)
    if (valid.contains(v)) found.add(double{v});
  return found;
}

// Returns whether `v` is the largest number of a usual integer type of 8 to 32 bits, rounded to a float.
bool is_largest_of_type(double v) {
  constexpr std::array largest = {255., 4095., 32767., 65535., 2147483648., 4294967296.};
  return std::ranges::find(largest, v) != largest.end();
}

// Returns whether terrain models use this value for unknown heights.
bool is_unknown_height(double v) {
  constexpr std::array usual = {-9999., -99999., -32767., -32768., -2147483648.};
  return std::ranges::find(usual, v) != usual.end();
}

// Returns a depth that exceeds about 1 % of all depths.
double nearest_depth(const DepthImage& image) {
  std::vector<float> depths;
  for (const float v : image.values.pixels)
    if (std::isfinite(v) && v > 0) depths.push_back(v);
  return depths.empty() ? 0 : double{value_of_rank(std::span(depths), depths.size() / 100)};
}

// Returns the share of the image's border that has the value.
double share_of_border(const Image<float>& values, double value) {
  double all = 0, found = 0;
  const auto look = [&](int x, int y) { all += 1, found += double{values.at(x, y)} == value; };
  for (int x = 0; x < values.width; ++x) look(x, 0), look(x, values.height - 1);
  for (int y = 0; y < values.height; ++y) look(0, y), look(values.width - 1, y);
  return found / all;
}

// Returns whether the highest value marks missing depths.
bool is_marker(const Extremes& it, const DepthImage& image, DepthValues kind) {
  const double range = it.range_below_highest(), gap = it.gap_below_highest();
  if (!(range > 0)) return false;
  // The highest inverse depth is that of the nearest surface. No nearest surface surrounds all others at one constant
  // depth, so a highest value along most of the border is a marker.
  const bool is_around =
      kind == DepthValues::inverse && gap > .1 * range && share_of_border(image.values, it.highest) > .5;
  if (is_largest_of_type(it.highest) && (gap > range || is_around)) return true;
  return kind == DepthValues::depth && gap > widest_gap * range;
}

}  // namespace

ValueRange ValueRange::none() {
  return {infinite, -infinite};
}

void ValueRange::extend(float v) {
  low = std::min(low, double{v}), high = std::max(high, double{v});
}

ValueRange valid_values(const DepthImage& image, DepthValues kind) {
  ValueRange valid{-infinite, infinite};
  const bool is_depth = kind == DepthValues::depth, is_inverse = kind == DepthValues::inverse;
  if (is_depth) valid.low = std::numeric_limits<double>::denorm_min();
  if (is_inverse) valid.low = 0;
  if (is_depth && image.step == 0) valid.high = farthest_depth * nearest_depth(image);
  const Extremes found = extremes_of(image, valid);
  if ((is_depth || is_inverse) && is_marker(found, image, kind)) valid.high = found.last_but_one;
  // An inverse depth of 0 is infinitely far. It is kept if other values are close to it, as in a sky.
  if (is_inverse && found.lowest == 0 &&
      found.second > farthest_inverse * std::min(found.highest, valid.high))
    valid.low = found.second;
  const bool is_gap_wide = found.second - found.lowest > found.highest - found.second;
  if (!is_depth && is_unknown_height(found.lowest) && is_gap_wide) valid.low = found.second;
  return valid;
}

HeightScale::HeightScale(const DepthImage& image, const DepthOptions& options, const ValueRange& range) {
  const Vec2 shape = image.pixel_shape();
  const double longer = std::max(shape.x() * image.values.width, shape.y() * image.values.height);
  const bool is_inverse = options.values == DepthValues::inverse;
  is_log_ = options.camera.has_value() || is_inverse;
  floor_ = is_inverse ? std::max(farthest_inverse * range.high, 1e-30) : 1e-30;
  // The camera of an estimated depth image is unknown. The focal length of most cameras is about 1.1 times
  // the image's longer side, which gives a field of view of about 50 degrees.
  const double focal = options.camera ? std::sqrt(options.camera->fx * options.camera->fy) : 1.1 * longer;
  scale_ = is_log_ ? focal : range.high > range.low ? options.range * longer / (range.high - range.low) : 1;
  if (options.values == DepthValues::depth) scale_ = -scale_;
}

// The uncertainty of a depth camera's values. The unit is the distance between neighbouring values that occur in the
// image. Such cameras write millimetres, but at large depths use only about every tenth value. Noise decides which of
// the two nearest values is written, so the uncertainty exceeds half of their distance.
constexpr double sensor_steps = 1.5;

ValueSteps::ValueSteps(const DepthImage& image) : least_(image.step / 2) {
  if (image.step == 0) return;
  // Depth cameras repeat each value many times. In other images few pixels have equal values, by chance, and
  // differences between such values are not steps.
  constexpr std::size_t least_pixels_per_value = 32;
  std::map<float, std::size_t> counts;
  std::size_t pixels = 0;
  for (const float v : image.values.pixels)
    if (std::isfinite(v)) ++counts[v], ++pixels;
  if (pixels < least_pixels_per_value * counts.size()) return;
  for (const auto& [value, count] : counts)
    if (count >= 3) values_.push_back(value);
}

bool ValueSteps::are_sensors() const {
  return values_.size() > 16 && uncertainty(values_[values_.size() / 2]) > 2 * least_;
}

double ValueSteps::uncertainty(float v) const {
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

}  // namespace relievo
