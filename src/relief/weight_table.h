// Tabulates equation (6). Frames look weights up in this table, because the formula needs an exponential
// and a logarithm.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "relievo/relief/weights.h"

namespace relievo {

// Interpolates linearly between entries that are evenly spaced within each octave of |k|: 128 entries per
// octave, from 2^-24 to 1. The leading bits of the float are the index. The error is at most 3e-5 for beta up
// to 2, and 1e-3 for beta up to 10.
class WeightTable {
 public:
  void fill(double delta, const Compression& compression) {
    if (!entries_.empty() && delta == delta_ && compression == compression_) return;
    delta_ = delta;
    compression_ = compression;
    entries_.resize(last_place - first_place + 2);
    for (std::size_t i = 0; i < entries_.size(); ++i) {
      const auto bits = (first_place + static_cast<std::uint32_t>(i)) << fraction_bits;
      entries_[i] = static_cast<float>(
          curvature_weight(static_cast<double>(std::bit_cast<float>(bits)), delta, compression));
    }
  }

  // Returns w_k for |k| <= 1.
  float operator()(float k) const {
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(std::abs(k));
    const std::uint32_t place = bits >> fraction_bits;
    if (place < first_place)  // rare: |k| < 2^-24
      return static_cast<float>(curvature_weight(static_cast<double>(k), delta_, compression_));
    const float* const entry = entries_.data() + (place - first_place);
    const float fraction =
        static_cast<float>(bits & ((1U << fraction_bits) - 1)) * (1.F / (1U << fraction_bits));
    return entry[0] + fraction * (entry[1] - entry[0]);
  }

 private:
  static constexpr std::uint32_t fraction_bits =
      16;  // fraction bits (of 23) for the interpolation; the other 7 belong to the index
  static constexpr std::uint32_t first_place = std::bit_cast<std::uint32_t>(0x1p-24F) >> fraction_bits;
  static constexpr std::uint32_t last_place = std::bit_cast<std::uint32_t>(1.F) >> fraction_bits;

  std::vector<float> entries_;
  double delta_ = 0;
  Compression compression_;
};

}  // namespace relievo
