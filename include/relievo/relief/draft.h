// Draft: reliefs whose walls all lean, so that a die, a mould or a cutter gets off them. After stages 12
// and 14.
#pragma once

#include <span>

#include "relievo/method.h"
#include "relievo/plate/solid.h"

namespace relievo {

// Returns the slope, rise over run, of a wall that leans by this angle, in (0, 90) degrees, off the vertical.
double slope_at_draft(double draft_deg);

// Returns the steepest slope of the triangles of a solid's front as files hold them: of corners in single
// precision. Infinite if a triangle that is not level stands upright or hangs over.
double steepest_slope(const Solid& solid);

struct DraftOptions {
  double max_slope = 1;  // no triangle may be steeper, > 0
  // Heights below the relief, one per point, in the surface's units: relief and base together keep the limit.
  // Empty for a plane.
  std::span<const double> base = {};
};

// A relief to order: see make_by_method().
struct DraftOrder {
  Method method = Method::ours;
  Shape shape;
  double height = 0;   // as of make_by_method()
  double unit_mm = 1;  // for messages
};

// Returns the relief with no triangle steeper than the limit that is nearest to the one given: over all
// triangles the least squares of what changes in their slopes, of which more than twice the limit counts as
// that, boundary points on the base. A relief that keeps the limit is returned as it is, bit for bit. What is
// returned keeps it with a thousandth to spare, so that it still does in single precision. About 0.5 s for
// 160k points. Errors: kind geometry if the base alone is steeper; those of HeightSystem::build(); kind
// cancelled.
Result<Relief> limit_draft(const ReliefModel& model, Relief relief, const DraftOptions& options,
                           Progress* progress = nullptr);

// Returns the relief of that height, met exactly, and of that method that keeps the limit: what is lost at
// walls is made up for by a larger u, or with the rivals by a larger scale. Errors: those of limit_draft()
// and make_by_method(); kind geometry if no relief under the limit is that high, telling the largest.
Result<Relief> make_with_draft(const ReliefModel& model, const DraftOrder& order, const DraftOptions& options,
                               Progress* progress = nullptr);

// Moves points of the solid's front up or down, by what rounding to single precision takes, until none of its
// triangles is steeper than the limit in a file; returns the largest move in mm, a few micrometres as a rule.
// The ground, the highest and the lowest points stay. Errors: kind geometry, and the solid as it was, if no
// such moves are found: the front was steeper before, or rounding does what they cannot make up for, to
// triangles between points that stay, or to points a few steps of single precision from each other or from an
// edge.
Result<double> hold_draft(Solid& solid, double max_slope);

}  // namespace relievo
