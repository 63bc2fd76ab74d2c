// Limits the slopes of reliefs to a draft angle, so that a die, a mould or a cutter can be withdrawn. Runs
// after stages 12 and 14.
#pragma once

#include <span>

#include "relievo/relief/method.h"
#include "relievo/relief/relief.h"

namespace relievo {

// Returns the slope (rise over run) of a wall at the angle `draft_deg`, in (0, 90) degrees, to the vertical.
double slope_at_draft(double draft_deg);

// The share of the limit below which reliefs are brought. It leaves a thousandth for the rounding of all later
// steps.
inline constexpr double kept_slope = .999;

struct DraftOptions {
  double max_slope = 1;  // largest slope that a triangle may have, > 0
  // Heights of the base, one per point, in the surface's units; empty for a plane. The limit applies to the
  // sum of relief and base.
  std::span<const double> base = {};
};

// The arguments of make_by_method() for the wanted relief.
struct DraftOrder {
  Method method = Method::layered;
  Shape shape;
  double height = 0;   // see make_by_method()
  double unit_mm = 1;  // millimetres per unit of the height, for messages
};

// Returns the relief nearest to `relief` that has no triangle steeper than the limit. Nearest means the least
// sum, over all triangles, of squared changes of slope; a slope of more than twice the limit counts as twice
// the limit. Boundary points stay on the base. A relief that keeps the limit is returned unchanged, bit for
// bit. Any other is brought a thousandth below the limit, so that it also keeps the limit in single
// precision. Takes about 0.5 s for 160k points. Errors: kind geometry if the base alone is steeper; those of
// HeightSystem::build(); kind cancelled.
Result<Relief> limit_draft(const ReliefModel& model, Relief relief, const DraftOptions& options,
                           Progress* progress = nullptr);

// Returns the relief of `order` that keeps the limit and has exactly the height asked for. The limit lowers
// walls; a larger u, or for baselines a larger scale, makes up for the lost height. Errors: those of
// limit_draft() and make_by_method(); kind geometry if no relief under the limit is that high, with the
// largest height in the message.
Result<Relief> make_with_draft(const ReliefModel& model, const DraftOrder& order, const DraftOptions& options,
                               Progress* progress = nullptr);

}  // namespace relievo
