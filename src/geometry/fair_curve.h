// Fits a smooth curve to measured points that scatter around it.
#pragma once

#include <span>
#include <vector>

#include "relievo/core/types.h"

namespace relievo {

struct CurveNode {
  Vec2 place;
  double weight = 1;  // > 0; reliability of the position
};

struct FairCurveOptions {
  double spacing = 1;  // distance between the curve's points
  // Each point of the curve is fitted to the nodes within this distance, measured along the curve. A larger
  // window gives a smoother curve.
  double window = 4;
  double corner_window = window;  // the window of the curve on which corners are sought
};

struct FairCurve {
  std::vector<Vec2> points;             // evenly spaced between corners; the first is not repeated at the end
  std::vector<std::uint8_t> is_corner;  // per point
};

// Returns the curve through nodes, which are given in their order along the curve. Each point of the curve
// lies on a quadratic that is fitted to the nearby nodes by weighted least squares. A second fit gives little
// weight to nodes far from the first curve. No fit crosses a corner. A corner is a turn of 45 to 110 degrees
// between straight sides, to which the nodes are about as close as to the smooth curve. The result is empty
// if the curve is shorter than four spacings, if an open curve has fewer than 3 nodes, or if a closed curve
// has fewer than 6.
FairCurve fair_curve(std::span<const CurveNode> nodes, bool is_closed, const FairCurveOptions& options);

}  // namespace relievo
