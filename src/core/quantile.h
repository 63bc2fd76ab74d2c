// Computes order statistics, in linear time. The functions reorder their argument, which must not be empty.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

namespace relievo {

// Returns the value at position `rank` in ascending order; rank < values.size().
template <typename T>
T value_of_rank(std::span<T> values, std::size_t rank) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

// Returns the value at position share * (n - 1), rounded down, of n values in ascending order; share in [0,
// 1].
template <typename Values>
auto quantile(Values&& values, double share) {
  return value_of_rank(std::span(values),
                       static_cast<std::size_t>(share * static_cast<double>(std::size(values) - 1)));
}

// Returns the median; for an even number of values the upper one of the middle two.
template <typename Values>
auto median(Values&& values) {
  return value_of_rank(std::span(values), std::size(values) / 2);
}

}  // namespace relievo
