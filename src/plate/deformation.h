// Refines flat triangles until they follow a deformation, for example onto a curved base or around a
// wrap. Tested by plate_base_test and wrap_test.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "relievo/plate/solid.h"

namespace relievo {

// The corners of a convex polygon, as indices of a solid's points, counter-clockwise seen from +Z.
using IndexPolygon = std::vector<Index>;

// Maps a flat body to a curved one. All functions may be called concurrently.
struct Deformation {
  std::function<Vec3(const Vec3&)> at;  // maps a point of the flat body to its place in the curved one
  // Returns the position, in (0, 1), where the segment between two points crosses a crease; nothing if it
  // crosses none. If the function is null, there are no creases.
  std::function<std::optional<double>(const Vec3&, const Vec3&)> crease_between = nullptr;
  // Along a line shorter than this length in mm, the deformed surface is approximately either convex or
  // concave, not both. The length determines the distance between the samples of the deviation.
  double min_feature_mm = std::numeric_limits<double>::infinity();
};

// The share of the tolerance that edges may use. On an evenly curved surface the interior of a triangle
// deviates by up to 4/3 as much as its edges. So if the edges stay within 3/4 of the tolerance, the
// interior stays within the whole tolerance.
inline constexpr double share_of_edges = .75;

// Subdivides the flat triangles until the deformed mesh deviates from the deformed surface by at most
// `tolerance_mm`. The points stay in the flat state. Edges shorter than 0.004 mm are never split. The parts
// of a triangle replace it and get its region. New points are appended; those on an edge of `outline` are
// also inserted into `outline`. Returns the largest remaining deviation in mm, sampled on edges and inside
// triangles.
double refine(Solid& flat, IndexPolygon& outline, const Deformation& deformation, double tolerance_mm);

}  // namespace relievo
