#include "quality/image_measures.h"

#include <algorithm>
#include <cmath>

#include "core/random.h"

namespace relievo {
PixelMask::PixelMask(Image8 image) : mask(std::move(image)) {
  for (Index i = 0; i < mask.size(); ++i)
    if (mask[i]) pixels.push_back(i);
}

Image<float> divergence(const Image<float>& x, const Image<float>& y, const PixelMask& where) {
  Image<float> sum = filled_image(x.width, x.height, 0.F);
  const auto w = static_cast<std::size_t>(x.width);
  for (const Index i : where.pixels) sum[i] = (x[i + 1] - x[i - 1] + y[i - w] - y[i + w]) / 2;
  return sum;
}

MaskedGaussian::MaskedGaussian(double sigma, int radius, const PixelMask& where)
    : filter_(sigma, radius), weight_(filled_image(where.mask.width, where.mask.height, 0.F)) {
  for (const Index i : where.pixels) weight_[i] = 1;
  filter_.apply(weight_);
}

void MaskedGaussian::apply(Image<float>& image, const PixelMask& where) const {
  filter_.apply(image);
  for (const Index i : where.pixels) image[i] /= weight_[i];
}

double correlation(const Image<float>& a, const Image<float>& b, const PixelMask& where) {
  double ma = 0, mb = 0, aa = 0, bb = 0, ab = 0;
  for (const Index i : where.pixels) ma += static_cast<double>(a[i]), mb += static_cast<double>(b[i]);
  const auto n = static_cast<double>(where.pixels.size());
  ma /= n, mb /= n;
  for (const Index i : where.pixels) {
    const double da = static_cast<double>(a[i]) - ma, db = static_cast<double>(b[i]) - mb;
    aa += da * da, bb += db * db, ab += da * db;
  }
  return aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : 0;
}

namespace {

// Returns the share of pairs that have the same order in z as in depth. next() returns the next pair of pixels; a
// pair whose second pixel is no_index is ignored.
template <typename Next>
double order_of_pairs(const Image<float>& z, const Image<float>& depth, const PixelMask& where, Next next) {
  const std::vector<Index>& at = where.pixels;
  if (at.empty()) return 0;
  const auto [low, high] = std::ranges::minmax_element(at, {}, [&](Index i) { return depth[i]; });
  const float least = .01F * (depth[*high] - depth[*low]);
  SplitMix64 random(1);  // fixed seed, so that the pairs of pixels are always the same
  std::size_t counted = 0, kept = 0;
  for (std::size_t pair = 0; pair < order_pairs; ++pair) {
    const auto [a, b] = next(random);
    if (b == no_index || !(std::abs(depth[a] - depth[b]) > least)) continue;
    ++counted;
    kept += (depth[a] > depth[b]) == (z[a] > z[b]) && z[a] != z[b];
  }
  return counted > 0 ? static_cast<double>(kept) / static_cast<double>(counted) : 0;
}

}  // namespace

double order_kept(const Image<float>& z, const Image<float>& depth, const PixelMask& where) {
  const auto any = [&](SplitMix64& random) { return where.pixels[random.bits() % where.pixels.size()]; };
  return order_of_pairs(z, depth, where, [&](SplitMix64& random) {
    const Index a = any(random);
    return std::pair(a, any(random));
  });
}

double near_order_kept(const Image<float>& z, const Image<float>& depth, const PixelMask& where) {
  const int side = std::max(depth.width, depth.height), far = static_cast<int>(farthest_near_pair * side);
  const double nearest = nearest_near_pair * side, farthest = farthest_near_pair * side;
  return order_of_pairs(z, depth, where, [&](SplitMix64& random) {
    const auto step = [&] { return static_cast<int>(random.bits() % (2 * far + 1)) - far; };
    const Index a = where.pixels[random.bits() % where.pixels.size()];
    const int dx = step(), dy = step();
    const int x = static_cast<int>(a) % depth.width + dx, y = static_cast<int>(a) / depth.width + dy;
    const double apart = std::hypot(dx, dy);
    const bool is_pair = apart >= nearest && apart <= farthest && x >= 0 && y >= 0 && x < depth.width &&
                         y < depth.height && where.mask[x + y * depth.width];
    return std::pair(a, is_pair ? static_cast<Index>(x + y * depth.width) : no_index);
  });
}

GaussianFilter::GaussianFilter(double sigma, int radius) : weights_(static_cast<std::size_t>(radius) + 1) {
  double sum = 0;
  for (int d = -radius; d <= radius; ++d) sum += std::exp(-d * d / (2 * sigma * sigma));
  for (int d = 0; d <= radius; ++d)
    weights_[static_cast<std::size_t>(d)] = static_cast<float>(std::exp(-d * d / (2 * sigma * sigma)) / sum);
}

void GaussianFilter::apply(Image<float>& image) const {
  const int width = image.width, height = image.height, radius = static_cast<int>(weights_.size()) - 1;
  const auto row_of = [&](Image<float>& from, int row) {
    return &from.at(0, std::clamp(row, 0, height - 1));
  };
  Image<float> down = filled_image(width, height, 0.F);
  for (int row = 0; row < height; ++row) {
    float* const to = row_of(down, row);
    for (int x = 0; x < width; ++x) to[x] = weights_[0] * row_of(image, row)[x];
    for (int d = 1; d <= radius; ++d) {
      const float *const above = row_of(image, row - d), *const below = row_of(image, row + d);
      for (int x = 0; x < width; ++x) to[x] += weights_[static_cast<std::size_t>(d)] * (above[x] + below[x]);
    }
  }
  std::vector<float> line(static_cast<std::size_t>(width + 2 * radius));
  for (int row = 0; row < height; ++row) {
    const float* const from = row_of(down, row);
    for (int x = -radius; x < width + radius; ++x) line[x + radius] = from[std::clamp(x, 0, width - 1)];
    float* const to = row_of(image, row);
    const float* const middle = line.data() + radius;
    for (int x = 0; x < width; ++x) to[x] = weights_[0] * middle[x];
    for (int d = 1; d <= radius; ++d)
      for (int x = 0; x < width; ++x)
        to[x] += weights_[static_cast<std::size_t>(d)] * (middle[x - d] + middle[x + d]);
  }
}

Image8 dilated(const Image8& mask, int radius) {
  const int width = mask.width, height = mask.height;
  Image8 across = filled_image(width, height, std::uint8_t{0}), out = across;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int other = std::max(0, x - radius); other <= std::min(width - 1, x + radius); ++other)
        across.at(x, y) |= mask.at(other, y);
  for (int y = 0; y < height; ++y)
    for (int other = std::max(0, y - radius); other <= std::min(height - 1, y + radius); ++other)
      for (int x = 0; x < width; ++x) out.at(x, y) |= across.at(x, other);
  return out;
}

}  // namespace relievo
