// Finds a relief of a given height (section 3.6): Algorithm 1.
#pragma once

#include <cmath>

namespace relievo::paper {

// The result of a search for a height: the coefficients of (6).
struct HeightToOrder {
  double alpha = 0, beta = 0;
  double height = 0;    // the height for these coefficients
  bool is_met = false;  // whether the height is within 1 % of the requested one
};

// Returns alpha and beta for which the height is within 1 % of `wanted`, with the smallest possible beta.
// `height_at(alpha, beta)` makes the relief and returns its height, which decreases with alpha; the last call
// is for the returned alpha and beta. Beta is doubled from 1e-5 to at most 100; if that is not enough,
// `is_met` is false. For each beta, alpha is doubled from 0.001 until the height falls below `wanted`; then
// bisection in (alpha / 2, alpha) finds alpha.
//
// The algorithm as printed has mistakes: line 4 lacks an absolute value, and its 0.001 is a length without a
// unit; lines 9 to 16 halve alpha in the wrong branch; lines 17 to 23 move both ends of the bracket at once.
// This function follows the section's text, with two changes. The number of doublings is also found by
// bisection, because for small beta one doubling hardly changes the height. Doubling ends at the largest
// double, instead of where the height changes by less than 0.001.
template <typename F>
HeightToOrder adjust_to_height(double wanted, F&& height_at) {
  constexpr double tolerance = .01, first_beta = 1e-5, last_beta = 100;
  constexpr int most_doublings = 1033;  // after more doublings alpha would be infinite
  HeightToOrder found;
  const auto is_below = [&](double alpha) {
    found.alpha = alpha;
    found.height = height_at(alpha, found.beta);
    found.is_met = std::abs(found.height - wanted) <= tolerance * wanted;
    return found.height < wanted;
  };
  const auto doubled = [](int times) { return std::ldexp(.001, times); };
  for (found.beta = first_beta; found.beta <= last_beta; found.beta *= 2) {
    const bool is_low_enough = is_below(doubled(most_doublings));
    if (found.is_met) return found;
    const bool is_high_enough = !is_below(doubled(0));
    if (found.is_met) return found;
    if (!is_low_enough || !is_high_enough) continue;
    int above = 0, below = most_doublings;
    while (!found.is_met && below - above > 1) {
      const int middle = (above + below) / 2;
      (is_below(doubled(middle)) ? below : above) = middle;
    }
    double low = doubled(above), high = doubled(below);
    while (!found.is_met && low + (high - low) / 2 > low) {
      const double middle = low + (high - low) / 2;
      (is_below(middle) ? high : low) = middle;
    }
    if (found.is_met) return found;
  }
  return found;
}

}  // namespace relievo::paper
