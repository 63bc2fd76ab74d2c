// Defines the saturation as a tone curve that the user draws. The curve is the share of a normal that is
// kept, as a function of the curvature |k|.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "relievo/core/error.h"
#include "relievo/core/types.h"

namespace relievo {

// A smooth curve through given points, as a function of sqrt(|k|). The square root expands the range of
// slight curvature, which most points of a scan have. Between two points the curve stays between their
// values; before the first and after the last point it is constant. Immutable.
class ToneCurve {
 public:
  static constexpr std::size_t most_points = 16;

  // Returns the curve through 1 to 16 points (sqrt(|k|), share kept), both in [0, 1], in ascending order of
  // sqrt(|k|). Errors: kind option for anything else.
  static Result<ToneCurve> through(std::vector<Vec2> points);

  const std::vector<Vec2>& points() const { return points_; }

  // Returns the share of the normal, in [0, 1], that is kept for a curvature k in [-1, 1].
  double operator()(double k) const;

  bool operator==(const ToneCurve&) const = default;

 private:
  explicit ToneCurve(std::vector<Vec2> points);

  std::vector<Vec2> points_;
  std::vector<double> slopes_;  // derivatives of the curve at the points
};

// Parses pairs of numbers separated by semicolons, such as "0,0.2;0.5,0.4;1,1". Errors: kind option, as for
// through().
Result<ToneCurve> parse_tone_curve(std::string_view text);

}  // namespace relievo
