// Draft: reliefs whose walls all lean, so that a die, a mould or a cutter can be drawn off them. Follows
// stages 12 and 14.
#pragma once

#include <span>

#include "relievo/relief/method.h"
#include "relievo/relief/relief.h"

namespace relievo {

// Returns the slope, rise over run, of a wall that leans by this angle, in (0, 90) degrees, off the vertical.
double slope_at_draft(double draft_deg);

struct DraftOptions {
  double max_slope = 1;  // no triangle may be steeper, > 0
  // Heights of the base, one per point, in the surface's units; empty for a plane. Relief and base together
  // keep the limit.
  std::span<const double> base = {};
};

// The relief wanted: see make_by_method().
struct DraftOrder {
  Method method = Method::layered;
  Shape shape;
  double height = 0;   // see make_by_method()
  double unit_mm = 1;  // millimetres per unit of the height, for messages
};

// Returns the relief closest to the one given that has no triangle steeper than the limit: it minimises the
// sum, over all triangles, of the squared changes of slope, where slopes of more than twice the limit count
// as twice the limit. Boundary points stay on the base. A relief that keeps the limit is returned unchanged,
// bit for bit; any other relief is brought a thousandth below the limit, so that it also keeps the limit in
// single precision. Takes about 0.5 s for 160k points. Errors: kind geometry if the base alone is steeper;
// those of HeightSystem::build(); kind cancelled.
Result<Relief> limit_draft(const ReliefModel& model, Relief relief, const DraftOptions& options,
                           Progress* progress = nullptr);

// Returns the relief of `order` that keeps the limit and has exactly the height asked for: a larger u, or
// with the baselines a larger scale, makes up for the height that is lost at walls. Errors: those of
// limit_draft() and make_by_method(); kind geometry if no relief under the limit is that high, with the
// largest height in the message.
Result<Relief> make_with_draft(const ReliefModel& model, const DraftOrder& order, const DraftOptions& options,
                               Progress* progress = nullptr);

}  // namespace relievo
