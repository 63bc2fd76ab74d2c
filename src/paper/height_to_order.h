// Finds a relief of a given height by Algorithm 1 of the paper (section 3.6).
#pragma once

#include <cmath>

namespace relievo::paper {

// The result of a search for the coefficients of (6) that give a height.
struct HeightToOrder {
  double alpha = 0, beta = 0;
  double height = 0;    // the height for these coefficients
  bool is_met = false;  // whether the height is within 1 % of the requested one
};

// Tries beta = 1e-5, 2e-5, 4e-5 and so on, up to 100. Returns the first beta for which an alpha gives a
// height within 1 % of `wanted`, and this alpha. If no beta succeeds, `is_met` is false.
// `height_at(alpha, beta)` makes the relief and returns its height, which decreases with alpha; the last call
// is for the returned alpha and beta. For each beta, bisection finds the first alpha of 0.001, 0.002, 0.004
// and so on at which the height is below `wanted`. Then bisection between alpha / 2 and alpha finds the
// result.
//
// The algorithm as printed has mistakes. Line 4 lacks an absolute value, and its 0.001 is a length without a unit.
// When the height first falls below `wanted`, line 12 leaves alpha as it is, so that the next height is the same and
// line 4 ends the loop. Lines 17 to 23 move both ends of the bracket at once. Line 5 refers to (8), but means (9).
//
// This function follows the section's text, with three changes. The number of doublings is found by bisection,
// because for small beta one doubling hardly changes the height. Doubling ends at the largest double, instead of
// where the height changes by less than 0.001. The loop over beta ends, too.
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
