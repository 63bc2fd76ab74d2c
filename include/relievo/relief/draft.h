// Limits the slopes of reliefs to a draft angle, so that a die, a mould or a cutter can be withdrawn. This
// step follows stages 12 and 14.
#pragma once

#include <span>

#include "relievo/relief/method.h"
#include "relievo/relief/relief.h"

namespace relievo {

// Returns the slope (rise over run) of a wall whose angle to the vertical is `draft_deg`, in (0, 90) degrees.
double slope_at_draft(double draft_deg);

// Slopes are reduced to at most this share of the limit, so that rounding in later steps cannot raise a slope
// above the limit.
inline constexpr double kept_slope = .999;

struct DraftOptions {
  double max_slope = 1;  // largest slope that a triangle may have, > 0
  // Heights of the base, one per point, in the surface's units; empty for a plane. The limit applies to the
  // slope of relief and base together.
  std::span<const double> base = {};
};

// The requested relief; see make_by_method() for these values.
struct DraftOrder {
  Method method = Method::layered;
  Shape shape;
  double height = 0;   // in units of the surface
  double unit_mm = 1;  // millimetres per unit of the height, for messages
};

// Returns the relief nearest to `relief` that has no triangle steeper than the limit. Nearest means that the
// squared slope changes, summed over all triangles, are smallest. In this sum, slopes above twice the limit
// count as twice the limit. Boundary points stay on the base. A relief within the limit is returned
// unchanged, bit for bit. Any other relief gets slopes of at most 0.999 times the limit, so that the relief
// satisfies the limit in single precision, too. Takes about 0.5 s for 160k points. Errors: kind geometry
// if the base alone is steeper than the limit; those of HeightSystem::build(); kind cancelled.
Result<Relief> limit_draft(const ReliefModel& model, Relief relief, const DraftOptions& options,
                           Progress* progress = nullptr);

// Returns the relief for `order` that is within the limit and has exactly the requested height. The limit
// lowers walls; a larger u (for baselines, a larger scale) compensates for the lost height. Errors: those of
// limit_draft() and make_by_method(); kind geometry if no relief within the limit is that high, with the
// largest height in the message.
Result<Relief> make_with_draft(const ReliefModel& model, const DraftOrder& order, const DraftOptions& options,
                               Progress* progress = nullptr);

}  // namespace relievo
