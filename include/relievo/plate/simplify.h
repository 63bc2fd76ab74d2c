// Fewer triangles for a height field mesh, within an error bound that is kept and reported.
#pragma once

#include <limits>

#include "relievo/core/progress.h"
#include "relievo/plate/solid.h"

namespace relievo {

struct SimplifiedMesh {
  HeightFieldMesh front;
  // Largest difference in height between the two surfaces, in mm. It is exact: both are flat between the
  // corners of their overlay, and it is measured at all of these.
  double error_mm = 0;
};

struct SimplifyOptions {
  double tolerance_mm = .01;  // > 0
  // Limit of the slopes of the new triangles, unless the front's own are steeper. The slope of a needle may
  // exceed it by the change that a micrometre in height causes.
  double max_slope = std::numeric_limits<double>::infinity();
  // Limit of the number of triangles: when it is reached, the error may exceed the tolerance. The points that
  // are always kept may need more.
  std::size_t most_triangles = std::numeric_limits<std::size_t>::max();
};

// Returns the front with fewer points, nowhere further from the original than `tolerance_mm`: a Delaunay
// triangulation to which the points of the front, or of its edges, with the largest error are added until no
// error exceeds the tolerance, or the number of triangles reaches its limit. The highest and the lowest point
// stay. Flat ground becomes few triangles and stays flat: the points on its boundary are kept. If `is_relief`
// is given, all points on the relief's rim are kept and the result's `is_relief` is set. A front that would
// get more triangles is returned as it is. Errors: kind option for a tolerance that is not positive; kind
// geometry for a front without triangles, or whose triangles are not a Delaunay triangulation up to rounding,
// so that they do not cover their hull; kind cancelled.
Result<SimplifiedMesh> simplify(const HeightFieldMesh& front, const SimplifyOptions& options,
                                Progress* progress = nullptr);

// Does the same without a limit of slopes.
Result<SimplifiedMesh> simplify(const HeightFieldMesh& front, double tolerance_mm,
                                Progress* progress = nullptr);

}  // namespace relievo
