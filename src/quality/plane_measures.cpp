#include "quality/plane_measures.h"

#include <algorithm>
#include <cmath>

#include "core/random.h"

namespace relievo {
namespace {}  // namespace

Measured::Measured(int w, std::vector<std::uint8_t> measured) : width(w), is_measured(std::move(measured)) {
  for (Index i = 0; i < is_measured.size(); ++i)
    if (is_measured[i]) pixels.push_back(i);
}

Plane divergence(const Plane& x, const Plane& y, const Measured& where) {
  Plane sum(x.size(), 0.F);
  const auto w = static_cast<std::size_t>(where.width);
  for (const Index i : where.pixels) sum[i] = (x[i + 1] - x[i - 1] + y[i - w] - y[i + w]) / 2;
  return sum;
}

MeasuredGaussian::MeasuredGaussian(double sigma, int radius, const Measured& where)
    : filter_(sigma, radius), weight_(where.is_measured.begin(), where.is_measured.end()) {
  if (!weight_.empty()) filter_.apply(weight_, where.width);
}

void MeasuredGaussian::apply(Plane& plane, const Measured& where) const {
  if (!plane.empty()) filter_.apply(plane, where.width);
  for (const Index i : where.pixels) plane[i] /= weight_[i];
}

double correlation(const Plane& a, const Plane& b, const Measured& where) {
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

double order_kept(const Plane& z, const Plane& depth, const Measured& where, std::size_t pairs) {
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
