// A smooth curve through measured places that scatter around it. Tested by
// tests/geometry/fair_curve_test.cpp.
#pragma once

#include <span>
#include <vector>

#include "relievo/core/types.h"

namespace relievo {

struct CurveNode {
  Vec2 place;
  double weight = 1;  // > 0, how much the place is trusted
};

struct FairCurveOptions {
  double spacing = 1;             // spacing of the curve's points
  double window = 4;              // half the length of curve that a point is fitted to; more is smoother
  double corner_window = window;  // the same for the curve on which corners are looked for
};

struct FairCurve {
  std::vector<Vec2> points;             // evenly spaced between corners; the first is not repeated at the end
  std::vector<std::uint8_t> is_corner;  // per point
};

// Returns the curve through nodes, which are given in their order along it. Each point of the curve lies on a
// quadratic fitted to the nodes nearby by weighted least squares. The fit is made twice: nodes far from the
// first curve count little in the second fit. Corners of 45 to 110 degrees between straight sides stay, if the
// nodes near them lie about as near to these sides as to the smooth curve: no fit goes across them. Empty if
// the curve is shorter than four spacings, if an open curve has fewer than 3 nodes or a closed one fewer than 6.
FairCurve fair_curve(std::span<const CurveNode> nodes, bool is_closed, const FairCurveOptions& options);

}  // namespace relievo
