// Rounds off the highest and the deepest points of a relief, so that a few do not take the height that all
// others need.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

#include "height_span.h"
#include "relievo/parallel.h"

namespace relievo {

struct TailOptions {
  double share = .01;      // of the points beyond each limit
  double flattest = .2;    // the curve's slope at the extremes
  bool keeps_base = true;  // 0 stays where it is; else only differences of heights mean something
  std::span<const std::uint8_t> left_out = {};  // without a base: not 0 where points do not count; or empty
};

// A curve over heights: rising everywhere, 1 : 1 in the middle, flatter beyond two limits.
template <typename Real>
class HeightTails {
 public:
  explicit HeightTails(std::span<const Real> heights, const TailOptions& options = {})
      : bend_(static_cast<Real>((1 - options.flattest) / 2)) {
    const HeightSpan<Real> span = counted_span(heights, options);
    lowest_ = highest_ = lower_ = upper_ = span.lowest;
    if (!(span.size() > 0)) return;
    highest_ = span.highest;
    const Histogram counts = histogram(heights, options.left_out);
    const double wanted = options.share * std::accumulate(counts.begin(), counts.end(), 0.0);
    upper_ = highest_ - bins_from_end(counts.rbegin(), counts.rend(), wanted) * bin();
    lower_ = lowest_ + bins_from_end(counts.begin(), counts.end(), wanted) * bin();
    if (options.keeps_base) upper_ = std::max(Real(0), upper_), lower_ = std::min(Real(0), lower_);
  }

  Real operator()(Real z) const {
    if (z > upper_) return upper_ + bent(z - upper_, highest_ - upper_);
    return z < lower_ ? lower_ - bent(lower_ - z, lower_ - lowest_) : z;
  }

  // Of the heights that count, before the curve.
  Real lowest() const { return lowest_; }

 private:
  static constexpr std::size_t bins = 2048;
  using Histogram = std::array<std::uint32_t, bins>;

  static bool counts_at(std::span<const std::uint8_t> left_out, std::size_t i) {
    return left_out.empty() || !left_out[i];
  }

  static HeightSpan<Real> counted_span(std::span<const Real> heights, const TailOptions& options) {
    if (options.keeps_base) return span_of(heights);
    constexpr Real infinity = std::numeric_limits<Real>::infinity();
    const HeightSpan<Real> span = parallel_reduce(
        heights.size(), HeightSpan<Real>{infinity, -infinity},
        [&](std::size_t begin, std::size_t end) {
          HeightSpan<Real> part{infinity, -infinity};
          for (std::size_t i = begin; i < end; ++i)
            if (counts_at(options.left_out, i)) part.extend(heights[i]);
          return part;
        },
        [](HeightSpan<Real> all, const HeightSpan<Real>& part) {
          all.extend(part);
          return all;
        });
    return span.lowest <= span.highest ? span : HeightSpan<Real>{};
  }

  Real bin() const { return (highest_ - lowest_) / static_cast<Real>(bins); }

  // From 0 with slope 1 to the end of the tail with the flattest slope.
  Real bent(Real z, Real length) const { return z - bend_ * z * z / length; }

  Histogram histogram(std::span<const Real> heights, std::span<const std::uint8_t> left_out) const {
    const Real per_unit = 1 / bin();
    return parallel_reduce(
        heights.size(), Histogram{},
        [&](std::size_t begin, std::size_t end) {
          Histogram counts{};
          for (std::size_t i = begin; i < end; ++i) {
            if (!counts_at(left_out, i)) continue;
            const auto at = static_cast<std::size_t>((heights[i] - lowest_) * per_unit);
            ++counts[std::min(at, bins - 1)];
          }
          return counts;
        },
        [](Histogram sum, const Histogram& counts) {
          for (std::size_t b = 0; b < bins; ++b) sum[b] += counts[b];
          return sum;
        },
        1 << 16);
  }

  // How many bins, with a fraction, hold the points wanted.
  template <typename It>
  static Real bins_from_end(It begin, It end, double wanted) {
    double sum = 0;
    for (It b = begin; b != end; ++b) {
      if (sum + *b > wanted) return static_cast<Real>(static_cast<double>(b - begin) + (wanted - sum) / *b);
      sum += *b;
    }
    return static_cast<Real>(bins);
  }

  Real bend_ = 0, lowest_ = 0, highest_ = 0, lower_ = 0, upper_ = 0;
};

}  // namespace relievo
