// Reduces the number of triangles of a height field mesh within an error bound, and reports the error.
#pragma once

#include <limits>

#include "relievo/core/progress.h"
#include "relievo/plate/solid.h"

namespace relievo {

struct SimplifiedMesh {
  HeightFieldMesh front;
  // Largest height difference between the two surfaces, in mm. The difference is exact, because it is
  // measured at all corners of the overlay of both surfaces, and both are flat between these corners.
  double error_mm = 0;
};

struct SimplifyOptions {
  double tolerance_mm = .01;  // > 0
  // Limit of the slopes of new triangles, except where the front's own triangles are steeper. A triangle that
  // is steeper than the limit must be within a millionth of a millimetre of the front. So it can be much
  // steeper than the front only if it is very thin.
  double max_slope = std::numeric_limits<double>::infinity();
  // Limit of the number of triangles. When it is reached, the error may exceed the tolerance. There may be
  // more triangles than the limit, because some points are always kept, see simplify().
  std::size_t most_triangles = std::numeric_limits<std::size_t>::max();
};

// Returns the front with fewer points. Its distance from the original is at most `tolerance_mm`. The result
// is a Delaunay triangulation. Points are added in rounds. Each round adds one point for every triangle whose
// error exceeds the tolerance. This point is where the error is largest: one of the front's points, or a
// point on one of the front's edges. The rounds end when no error exceeds the tolerance or the limit of
// triangles is reached. The highest and the lowest point are kept. Flat ground is reduced to few triangles
// and stays flat, because all points on its boundary are kept. If `is_relief` is given, all points on the
// relief's rim are kept, and `is_relief` of the result is set. If the result would have more triangles than
// the front, the front is returned unchanged. Errors: kind option for a tolerance that is not positive; kind
// geometry for a front without triangles, and for triangles that do not cover their hull, because they are
// not a Delaunay triangulation up to rounding; kind cancelled.
Result<SimplifiedMesh> simplify(const HeightFieldMesh& front, const SimplifyOptions& options,
                                Progress* progress = nullptr);

// Simplifies the front without a limit for slopes.
Result<SimplifiedMesh> simplify(const HeightFieldMesh& front, double tolerance_mm,
                                Progress* progress = nullptr);

}  // namespace relievo
