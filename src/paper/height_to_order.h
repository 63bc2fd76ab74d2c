// A relief of a given height (section 3.6): Algorithm 1.
#pragma once

#include <cmath>

namespace relievo::paper {

// The coefficients of (6) at which a height was looked for.
struct HeightToOrder {
  double alpha = 0, beta = 0;
  double height = 0;    // the height that they give
  bool is_met = false;  // whether it is within 1 % of the height asked for
};

// Returns alpha and beta at which the height is within 1 % of `wanted`, for the smallest beta that has such an
// alpha. `height_at(alpha, beta)` makes the relief and returns its height, which falls with alpha; the last call
// made the relief that is returned. Beta is doubled from 1e-5; if none up to 100 gives the height, `is_met` is
// false. For each beta, alpha is doubled from 0.001 until the height falls below the one wanted, and is then
// found by bisection in (alpha / 2, alpha).
//
// The listing does not run as it is printed: line 4 lacks an absolute value, and its 0.001 is a length in no
// unit; lines 9 to 16 halve alpha in the wrong branch; lines 17 to 23 move both ends of the bracket at once. The
// section's text says what is meant. Two things are added. The number of doublings is found by bisection, too,
// because heights change little by one doubling if beta is small. Doubling ends at the largest number, instead
// of where the height changes by less than 0.001.
template <typename F>
HeightToOrder adjust_to_height(double wanted, F&& height_at) {
  constexpr double tolerance = .01, first_beta = 1e-5, last_beta = 100;
  constexpr int most_doublings = 1033;  // the last whose alpha is finite
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
