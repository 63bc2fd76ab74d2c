// Saturation as a tone curve: the share of a normal that is kept, drawn by hand over the curvature |k|.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "relievo/core/error.h"
#include "relievo/core/types.h"

namespace relievo {

// A smooth curve through points, over the square root of |k|: most of a scan's curvature is slight, and the
// root gives slight curvature more room. Between two points the curve stays between their values; before the
// first and after the last it is level. Immutable.
class ToneCurve {
 public:
  static constexpr std::size_t most_points = 16;

  // Takes 1 to 16 points (sqrt(|k|), share kept), both in [0, 1], in ascending order of the first. Errors:
  // kind option for anything else.
  static Result<ToneCurve> through(std::vector<Vec2> points);

  const std::vector<Vec2>& points() const { return points_; }

  // Returns the share of the normal, in [0, 1], that is kept at a curvature k in [-1, 1].
  double operator()(double k) const;

  bool operator==(const ToneCurve&) const = default;

 private:
  explicit ToneCurve(std::vector<Vec2> points);

  std::vector<Vec2> points_;
  std::vector<double> slopes_;  // at the points
};

// Parses "0,0.2;0.5,0.4;1,1", pairs of numbers with semicolons between. Errors: kind option, as through().
Result<ToneCurve> parse_tone_curve(std::string_view text);

}  // namespace relievo
