// Reduces the triangles of a height field mesh within an error bound, and reports the error.
#pragma once

#include <limits>

#include "relievo/core/progress.h"
#include "relievo/plate/solid.h"

namespace relievo {

struct SimplifiedMesh {
  HeightFieldMesh front;
  // Largest difference in height between the two surfaces, in mm. It is exact, because it is measured at all
  // corners of the surfaces' overlay, and both surfaces are flat between these corners.
  double error_mm = 0;
};

struct SimplifyOptions {
  double tolerance_mm = .01;  // > 0
  // Limit of the slopes of the new triangles, unless the front's own triangles are steeper. A needle may
  // exceed the limit by the slope that a micrometre in height causes.
  double max_slope = std::numeric_limits<double>::infinity();
  // Limit of the number of triangles. If it is reached, the error may exceed the tolerance. The points that
  // are always kept may need more triangles.
  std::size_t most_triangles = std::numeric_limits<std::size_t>::max();
};

// Returns the front with fewer points, nowhere further from the original than `tolerance_mm`. The result is a
// Delaunay triangulation. To it are added the points of the front, or on the front's edges, that have the
// largest error, until no error exceeds the tolerance or the number of triangles reaches its limit. The
// highest and the lowest point stay. Flat ground becomes few triangles and stays flat, because the points on
// its boundary are kept. If `is_relief` is given, all points on the relief's rim are kept and the result's
// `is_relief` is set. A front that would get more triangles is returned unchanged. Errors: kind option for a
// tolerance that is not positive; kind geometry for a front without triangles, or with triangles that are not
// a Delaunay triangulation up to rounding, so that they do not cover their hull; kind cancelled.
Result<SimplifiedMesh> simplify(const HeightFieldMesh& front, const SimplifyOptions& options,
                                Progress* progress = nullptr);

// Simplifies without a limit of slopes.
Result<SimplifiedMesh> simplify(const HeightFieldMesh& front, double tolerance_mm,
                                Progress* progress = nullptr);

}  // namespace relievo
