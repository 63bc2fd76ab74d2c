// The width of a relief in a plate of a given size.
#include <algorithm>
#include <limits>
#include <vector>

#include "pipeline/body.h"
#include "relievo/core/text.h"
#include "relievo/make_relief.h"
#include "relievo/plate/outline.h"
#include "relievo/scan/surface.h"

namespace relievo {
namespace {

// Returns the hull of a relief, scaled to a longer side of 1.
std::vector<Vec2> unit_hull(const Surface& surface) {
  const double longer_side = surface.longer_side();
  std::vector<Vec2> hull;
  for (const Index i : surface.triangulation.hull)
    hull.emplace_back(surface.points[i].head<2>() / longer_side);
  return hull;
}

Vec2 middle_of(const std::vector<Vec2>& polygon) {
  const Box box = Box::of(polygon);
  return ((box.min + box.max) / 2).head<2>();
}

// Returns the largest width of a relief that keeps margin and rim from all sides of the plate. The middles of
// its hull and of the plate's outline coincide, so that each side of the outline limits the scale
// independently.
double largest_width_mm(const Surface& surface, const ReliefOptions& options) {
  const double edge_mm = options.effective_margin_mm() + options.rim_mm.value_or(0);
  const std::vector<Vec2> hull = unit_hull(surface);
  const std::vector<Vec2> outline =
      outline_around(hull, {options.outline, options.corner_mm, edge_mm, plate_size_of(options)});
  const Vec2 middle = middle_of(outline);
  double width = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 along = outline[(i + 1) % outline.size()] - outline[i];
    const Vec2 normal = Vec2(along.y(), -along.x()).normalized();
    double farthest = 0;
    for (const Vec2& p : hull) farthest = std::max(farthest, (p - middle).dot(normal));
    const double room_mm = (outline[i] - middle - options.shift_mm).dot(normal) - edge_mm;
    if (farthest > 0) width = std::min(width, room_mm / farthest);
  }
  return width;
}

}  // namespace

Result<ReliefOptions> with_width(const Surface& surface, const ReliefOptions& options) {
  ReliefOptions sized = options;
  if (plate_size_of(options).x() == 0) {
    sized.width_mm = options.effective_width_mm();
    return sized;
  }
  const double largest = largest_width_mm(surface, options);
  sized.width_mm = options.width_mm.value_or(largest);
  constexpr double rounding = 1 + 1e-6;  // tolerance for a width copied from a report
  if (*sized.width_mm > 0 && *sized.width_mm <= largest * rounding) return sized;
  return option_error(
      "width", cat("expected at most ", std::max(0.0, largest), " mm, which the plate leaves with its margin",
                   options.rim_mm ? " and rim" : "", ", found ", *sized.width_mm, " mm"));
}

}  // namespace relievo
