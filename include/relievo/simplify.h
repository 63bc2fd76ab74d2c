// Fewer triangles for a front, within an error that is kept and told.
#pragma once

#include <limits>

#include "relievo/core/progress.h"
#include "relievo/plate/solid.h"

namespace relievo {

struct SimplerFront {
  Front front;
  // Largest difference in height between the two surfaces over the whole front, in mm: both are flat between
  // the corners of their overlay, and it was measured at all of these.
  double error_mm = 0;
};

struct SimplifyOptions {
  double tolerance_mm = .01;  // > 0
  // No triangle becomes steeper, unless the front's are; up to what a micrometre more or less makes of
  // needles.
  double max_slope = std::numeric_limits<double>::infinity();
};

// Returns the front with fewer points, no further from the original than `tolerance_mm` anywhere: the
// Delaunay triangulation of those of its points, and of its edges, that were off the most, added until none
// is off by more. The highest and the lowest point stay. Flat ground becomes a few triangles. A front
// that tells what is relief keeps all points of the relief's rim, and tells it of its triangles, too. Errors:
// kind option for a tolerance that is not positive; kind geometry for a front without triangles, or whose
// triangles are not Delaunay's up to rounding, so that they do not cover their hull; kind cancelled.
Result<SimplerFront> simplify(const Front& front, const SimplifyOptions& options,
                              Progress* progress = nullptr);

// The same, however steep triangles become.
Result<SimplerFront> simplify(const Front& front, double tolerance_mm, Progress* progress = nullptr);

}  // namespace relievo
