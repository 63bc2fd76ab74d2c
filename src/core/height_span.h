// Finds the lowest and the highest of a set of heights.
#pragma once

#include <array>
#include <span>

#include "relievo/core/parallel.h"

namespace relievo {

template <typename Real>
struct HeightSpan {
  Real lowest = 0, highest = 0;  // initially 0, because the base counts as a height

  void extend(Real z) {
    lowest = z < lowest ? z : lowest;
    highest = z > highest ? z : highest;
  }
  void extend(const HeightSpan& other) {
    extend(other.lowest);
    extend(other.highest);
  }
  Real size() const { return highest - lowest; }
};

// Returns the span of consecutive heights, in the calling thread. Eight spans are computed in parallel, so
// that the compiler uses vector instructions.
template <typename Real>
HeightSpan<Real> span_of_run(std::span<const Real> heights) {
  constexpr std::size_t lanes = 8;
  std::array<Real, lanes> low{}, high{};
  std::size_t i = 0;
  for (; i + lanes <= heights.size(); i += lanes) {
    for (std::size_t l = 0; l < lanes; ++l) {
      low[l] = heights[i + l] < low[l] ? heights[i + l] : low[l];
      high[l] = heights[i + l] > high[l] ? heights[i + l] : high[l];
    }
  }
  HeightSpan<Real> span;
  for (; i < heights.size(); ++i) span.extend(heights[i]);
  for (std::size_t l = 0; l < lanes; ++l) span.extend(low[l]), span.extend(high[l]);
  return span;
}

template <typename Real>
HeightSpan<Real> span_of(std::span<const Real> heights) {
  return parallel_reduce(
      heights.size(), HeightSpan<Real>{},
      [&](std::size_t begin, std::size_t end) { return span_of_run(heights.subspan(begin, end - begin)); },
      [](HeightSpan<Real> all, const HeightSpan<Real>& part) {
        all.extend(part);
        return all;
      });
}

// Returns the highest minus the lowest of the heights; the base, 0, counts as a height.
inline double height_span(std::span<const double> heights) {
  return span_of(heights).size();
}

}  // namespace relievo
