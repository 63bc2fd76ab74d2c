// Softly clips the few highest and deepest points of a relief. Otherwise they would use up much of the
// height.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "core/height_span.h"
#include "relievo/core/parallel.h"

namespace relievo {

// A monotone function of the height: the identity between two limits, and flatter beyond them. A share
// `clipped_share` of the points lies beyond each limit. Beyond a limit the slope falls from 1 to
// `least_slope` at the extreme height. The base, height 0, is never beyond a limit.
template <typename Real>
class SoftClip {
 public:
  // docs/method.md, "The height correction", has the reason for these values.
  static constexpr double clipped_share = .002, least_slope = .12;

  explicit SoftClip(std::span<const Real> heights) {
    const HeightSpan<Real> span = span_of(heights);
    lowest_ = lower_ = span.lowest;
    highest_ = upper_ = span.highest;
    if (!(span.size() > 0)) return;
    const Histogram counts = histogram(heights);
    const double wanted = clipped_share * static_cast<double>(heights.size()) / stride;
    upper_ = std::max(Real(0), highest_ - bins_from_end(counts.rbegin(), counts.rend(), wanted) * bin());
    lower_ = std::min(Real(0), lowest_ + bins_from_end(counts.begin(), counts.end(), wanted) * bin());
  }

  Real operator()(Real z) const {
    if (z > upper_) return upper_ + bent(z - upper_, highest_ - upper_);
    return z < lower_ ? lower_ - bent(lower_ - z, lower_ - lowest_) : z;
  }

  // Returns the span of the clipped heights, 0 included.
  Real span() const { return (*this)(highest_) - (*this)(lowest_); }

 private:
  static constexpr std::size_t bins = 2048, stride = 4;  // every fourth height is counted
  using Histogram = std::array<std::uint32_t, bins>;

  Real bin() const { return (highest_ - lowest_) / static_cast<Real>(bins); }

  // Returns the value at z of a parabola that has slope 1 at 0 and slope `least_slope` at `length`.
  static Real bent(Real z, Real length) {
    return z - static_cast<Real>((1 - least_slope) / 2) * z * z / length;
  }

  Histogram histogram(std::span<const Real> heights) const {
    const Real per_unit = 1 / bin();
    return parallel_reduce(
        heights.size(), Histogram{},
        [&](std::size_t begin, std::size_t end) {
          Histogram counts{};
          for (std::size_t i = begin; i < end; i += stride) {
            const auto at = static_cast<std::size_t>((heights[i] - lowest_) * per_unit);
            ++counts[std::min(at, bins - 1)];
          }
          return counts;
        },
        [](Histogram sum, const Histogram& counts) {
          for (std::size_t b = 0; b < bins; ++b) sum[b] += counts[b];
          return sum;
        },
        1 << 15);
  }

  // Returns the number of bins, counted from `begin`, that together contain `wanted` points; the last bin
  // counts in part.
  template <typename It>
  static Real bins_from_end(It begin, It end, double wanted) {
    double sum = 0;
    for (It b = begin; b != end; ++b) {
      if (sum + *b > wanted) return static_cast<Real>(static_cast<double>(b - begin) + (wanted - sum) / *b);
      sum += *b;
    }
    return static_cast<Real>(bins);
  }

  Real lowest_ = 0, highest_ = 0, lower_ = 0, upper_ = 0;
};

}  // namespace relievo
