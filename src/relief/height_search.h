// Finds the u at which a relief has the requested height. The height grows with u, so every search looks for
// the root of ln(height(u) / height) as a function of ln u.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/root_finding.h"
#include "relievo/core/error.h"
#include "relievo/core/text.h"

namespace relievo {

// Returns the error for a height that no relief of this view reaches; `most_mm` is the largest possible
// height.
inline std::unexpected<Error> out_of_reach(double most_mm, double wanted_mm) {
  return geometry_error(
      cat("expected a height that can be reached, at most ", most_mm, " mm for this view and width, found ",
          wanted_mm, " mm",
          most_mm > 0 ? "; --method detail reaches it, as it makes small shapes higher than they are"
                      : ": this view shows a level face alone; choose another"));
}

// Every search calls height_at(ln u), which makes a relief and returns its height. The result of a search is
// the relief of the last call. To end a search early, for example after an error, height_at() returns the
// requested height.
class HeightSearch {
 public:
  // `tolerance` is the largest accepted error of ln(height).
  HeightSearch(double height, double tolerance) : height_(height), tolerance_(tolerance) {}

  // Computes a secant step in ln u, limited to [least, most]. `elasticity` is d ln(height) / d ln(u). The
  // secant's step is multiplied by `gain`.
  struct SecantStep {
    double gain = 1, least = -2, most = 2;

    double operator()(double excess, double elasticity) const {
      return std::clamp(-gain * excess / elasticity, least, most);
    }
  };

  // The result of the last search in a series of similar reliefs, for track().
  struct Track {
    double log_u = 0, elasticity = 1;
    std::optional<double> log_height = {};  // ln height at that u; empty before the first success
  };

  // Searches without a first guess. Tries u = infinity first, to find out whether the height can be reached,
  // then brackets u. Returns whether the height is reached; if not, the last relief is the highest one. If
  // the height as a function of u jumps past the requested height, or exceeds it for every u, the last
  // relief is too high. Then the caller has to scale it down.
  template <typename F>
  bool bracket(F&& height_at) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double excess = excess_of(height_at(infinity));
    if (excess <= tolerance_) return excess >= -tolerance_;
    const auto excess_at = [&](double log_u) { return excess = excess_of(height_at(log_u)); };
    find_root(excess_at, tolerance_);
    return excess >= -tolerance_ || excess_at(infinity) >= -tolerance_;
  }

  // Searches in a series of reliefs, each similar to the last one. Starts at the u that the last height and elasticity
  // predict, and takes secant steps; one or two calls are usually enough. After six secant steps it brackets u instead.
  // This happens after large changes, and for heights at or above the largest possible height.
  template <typename F>
  bool track(Track& last, F&& height_at) const {
    constexpr int most_secants = 6;
    // Elasticities below this value are rounding errors of single precision, or occur near the largest height.
    constexpr double least_elasticity = .02;
    constexpr SecantStep step;
    double x = last.log_u;
    if (last.log_height) x += step(*last.log_height - std::log(height_), last.elasticity);
    const auto excess_at = [&](double log_u) { return excess_of(height_at(x = log_u)); };
    double excess = excess_at(x);
    for (int round = 0; round < most_secants && std::abs(excess) > tolerance_; ++round) {
      const double before = x, excess_before = excess;
      excess = excess_at(x + step(excess, last.elasticity));
      const double elasticity = (excess - excess_before) / (x - before);
      if (x != before && elasticity > least_elasticity) last.elasticity = elasticity;
    }
    const auto height_of = [&](double log_u) {
      const double height = height_at(x = log_u);
      excess = excess_of(height);
      return height;
    };
    const bool is_met = std::abs(excess) <= tolerance_ || bracket(height_of);
    if (is_met && std::isfinite(x)) {
      last.log_u = x;
      last.log_height = excess + std::log(height_);
    }
    return is_met;
  }

  // Searches with few calls, for reliefs that take long to make. The first secant steps go upwards from
  // `low`, which must give a height that is not too high. Then false position narrows the bracket, and every
  // third step is a bisection. The resulting height is at least the requested one, and exceeds it by at most
  // twice the tolerance. Returns false if the relief at `last` is too low.
  template <typename F>
  bool climb(double low, double last, F&& height_at) const {
    constexpr int most_reliefs = 24;
    // Steps are a tenth longer than secant steps, so that they end slightly above the requested height. Such
    // a step closes the bracket and saves a relief.
    constexpr SecantStep step{1.1, .01, 1.5};
    // Limits of the elasticity. Heights grow with u, but more slowly where the slopes of the steepest walls
    // are limited.
    constexpr double least_elasticity = .05, most_elasticity = 2;
    // If the next step would end less than `near_last` before `last`, or beyond it, the relief at `last`
    // is made instead. If the relief at `last` is too low, the search fails.
    constexpr double near_last = .3;
    const auto excess_at = [&](double x) { return excess_of(height_at(x)) - tolerance_; };
    double excess = excess_at(low), low_excess = excess, high = last, high_excess = 0, elasticity = 1;
    bool has_high = false;
    for (int tries = 0; std::abs(excess) > tolerance_ && tries < most_reliefs; ++tries) {
      double x = low + step(low_excess, elasticity);
      if (has_high) x = low + (high - low) * (tries % 3 == 2 ? .5 : low_excess / (low_excess - high_excess));
      if (!has_high && x > last - near_last) x = last;
      excess = excess_at(x);
      if (excess < -tolerance_ && x == last) return false;
      if (excess > 0) {
        high = x, high_excess = excess, has_high = true;
      } else {
        elasticity = std::clamp((excess - low_excess) / (x - low), least_elasticity, most_elasticity);
        low = x, low_excess = excess;
      }
    }
    return true;
  }

 private:
  double excess_of(double height) const { return std::log(std::max(height, 1e-300) / height_); }

  double height_, tolerance_;
};

}  // namespace relievo
