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

double order_kept(const Image<float>& z, const Image<float>& depth, const PixelMask& where,
                  std::size_t pairs) {
  const std::vector<Index>& at = where.pixels;
  if (at.empty()) return 0;
  const auto [low, high] = std::ranges::minmax_element(at, {}, [&](Index i) { return depth[i]; });
  const float least = .01F * (depth[*high] - depth[*low]);
  SplitMix64 random(1);  // the same pairs of pixels everywhere
  std::size_t counted = 0, kept = 0;
  for (std::size_t pair = 0; pair < pairs; ++pair) {
    const Index a = at[random.bits() % at.size()], b = at[random.bits() % at.size()];
    if (!(std::abs(depth[a] - depth[b]) > least)) continue;
    ++counted;
    kept += (depth[a] > depth[b]) == (z[a] > z[b]) && z[a] != z[b];
  }
  return counted > 0 ? static_cast<double>(kept) / static_cast<double>(counted) : 0;
}

}  // namespace relievo
