// Refines flat triangles until they follow a deformation of space, such as onto a curved base or around a
// wrap. Tested by plate_base_test and wrap_test.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "relievo/plate/solid.h"

namespace relievo {

// A convex polygon of the solid's points, counter-clockwise seen from +Z.
using IndexPolygon = std::vector<Index>;

// A map of the points of a flat body to those of a curved one. All functions may be called concurrently.
struct Deformation {
  std::function<Vec3(const Vec3&)> at;  // maps a point of the flat body to the curved one
  // Returns the position, in (0, 1), at which the segment between two points crosses a crease; nothing if it
  // crosses no crease. May be null.
  std::function<std::optional<double>(const Vec3&, const Vec3&)> crease_between = nullptr;
  // An approximate length in mm within which the map curves to one side only. It determines the distance of
  // the samples of the error.
  double min_feature_mm = std::numeric_limits<double>::infinity();
};

// The part of the tolerance that edges may use. Where a surface curves evenly, the inside of a triangle
// deviates by up to 4/3 of its edges' deviation, so edges within 3/4 of the tolerance keep the inside within
// all of it.
inline constexpr double share_of_edges = .75;

// Subdivides the flat triangles until the deformed mesh deviates from the deformed surface by at most
// `tolerance_mm`; the triangles themselves stay flat. Edges shorter than 0.004 mm are never split. The parts
// of a triangle replace it and get its region. New points are appended, and new points on an edge of
// `outline` are also inserted into `outline`. Returns the largest deviation that is left, in mm, as sampled
// on edges and inside.
double refine(Solid& flat, IndexPolygon& outline, const Deformation& deformation, double tolerance_mm);

}  // namespace relievo
