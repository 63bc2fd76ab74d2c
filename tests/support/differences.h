// Compares two sequences of numbers or vectors.
#pragma once

#include <cmath>
#include <limits>
#include <type_traits>

#include "relievo/core/types.h"

namespace relievo::test {

template <typename A, typename B>
requires std::is_arithmetic_v<A> && std::is_arithmetic_v<B>
double difference(A a, B b) {
  return std::abs(static_cast<double>(a) - static_cast<double>(b));
}
template <typename Vector>
requires requires(Vector v) {
  v.norm();
}
double difference(const Vector& a, const Vector& b) {
  return static_cast<double>((a - b).norm());
}

// Returns the largest difference between elements with the same index; infinity if the sequences have
// different sizes.
template <typename A, typename B>
double largest_difference(const A& a, const B& b) {
  if (std::size(a) != std::size(b)) return std::numeric_limits<double>::infinity();
  double largest = 0;
  for (std::size_t i = 0; i < std::size(a); ++i) {
    const double one = difference(a[i], b[i]);
    if (!(one <= largest)) largest = one;  // the condition is true for NaN, too
  }
  return largest;
}

template <typename A, typename B>
double root_mean_square(const A& a, const B& b) {
  if (std::size(a) != std::size(b)) return std::numeric_limits<double>::infinity();
  double sum = 0;
  for (std::size_t i = 0; i < std::size(a); ++i) sum += difference(a[i], b[i]) * difference(a[i], b[i]);
  return std::sqrt(sum / static_cast<double>(std::size(a)));
}

}  // namespace relievo::test
