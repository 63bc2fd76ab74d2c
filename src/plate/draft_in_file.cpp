#include "relievo/plate/draft_in_file.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "geometry/slope_limit.h"
#include "plate/coincident_points.h"

namespace relievo {
namespace {

// The front of a solid, with coordinates rounded as in a file.
struct StoredFront {
  std::vector<Vec2> plane;
  std::vector<double> heights;
  std::vector<std::uint8_t> is_fixed;
  std::span<const Triangle> triangles;

  explicit StoredFront(const Solid& solid)
      : is_fixed(solid.points.size(), 1), triangles(std::span(solid.triangles).first(solid.front_triangles)) {
    for (const Vec3f& p : stored_points(solid)) {
      plane.push_back(p.head<2>().cast<double>());
      heights.push_back(static_cast<double>(p.z()));
    }
  }

  PlaneMesh field() const { return {plane, triangles, is_fixed}; }

  // Lets the heights of most front points change. These points keep their heights: the lowest and the highest
  // ones, those of the outline (top of the walls), and those at the outline's height (flat ground).
  void free_inner_points(const Solid& solid) {
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
    for (const Triangle& t : triangles)
      for (const Index i : t) {
        is_fixed[i] = 0;
        lowest = std::min(lowest, heights[i]), highest = std::max(highest, heights[i]);
      }
    double ground = lowest;
    for (const Triangle& t : std::span(solid.triangles).subspan(solid.front_triangles))
      for (const Index i : t)
        if (!std::exchange(is_fixed[i], 1)) ground = heights[i];
    for (std::size_t i = 0; i < heights.size(); ++i)
      if (heights[i] == lowest || heights[i] == highest || heights[i] == ground) is_fixed[i] = 1;
  }
};

}  // namespace

double steepest_slope(const Solid& solid) {
  const StoredFront front(solid);
  return steepest_of(front.field(), front.heights);
}

Result<double> enforce_draft_in_float(Solid& solid, double max_slope) {
  StoredFront front(solid);
  front.free_inner_points(solid);
  const std::vector<double> before = front.heights;
  if (!limit_slopes(front.field(), max_slope, Rounding::single_precision, front.heights))
    return geometry_error("draft",
                          "expected triangles that keep the limit in single precision, found some "
                          "that do not: fewer points help, as a tolerance leaves");
  double largest = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (front.heights[i] == before[i]) continue;
    solid.points[i].z() = front.heights[i];
    largest = std::max(largest, std::abs(front.heights[i] - before[i]));
  }
  return largest;
}

}  // namespace relievo
