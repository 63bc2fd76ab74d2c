#include "plate/plate_checks.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "relievo/core/text.h"

namespace relievo {
namespace {

// Below a micrometre, rounding to single precision would make rim or walls degenerate.
constexpr double least_size_mm = 1e-3;
constexpr double least_tolerance_mm = 1e-4;  // finer ones would follow the rounding of files

bool is_good(double mm) {
  return std::isfinite(mm) && mm >= least_size_mm;
}

std::string wanted_length(double mm) {
  return cat("expected a finite length of at least 0.001 mm, found ", mm);
}

Result<void> check_rim(const PlateOptions& options) {
  const RimOptions& rim = options.rim;
  if (rim.width_mm == 0) return {};
  if (options.outline == Outline::none)
    return option_error("rim", "expected an outline to lie along, found none");
  if (!is_good(rim.width_mm)) return option_error("rim", wanted_length(rim.width_mm));
  if (!is_good(std::abs(rim.height_mm))) return option_error("rim-height", wanted_length(rim.height_mm));
  if (!is_good(rim.bevel_mm) || rim.bevel_mm > rim.width_mm)
    return option_error("rim-bevel", cat("expected 0.001 mm to ", rim.width_mm,
                                         " mm, the rim's width, found ", rim.bevel_mm, " mm"));
  return {};
}

Result<void> check_options(const PlateOptions& options) {
  if (!is_good(options.margin_mm)) return option_error("margin", wanted_length(options.margin_mm));
  if (!is_good(options.thickness_mm)) return option_error("thickness", wanted_length(options.thickness_mm));
  if (options.outline == Outline::round && !is_good(options.corner_mm))
    return option_error("corner", wanted_length(options.corner_mm));
  if (!(options.tolerance_mm >= least_tolerance_mm && std::isfinite(options.tolerance_mm)))
    return option_error("tolerance",
                        cat("expected a finite length of at least 0.0001 mm, found ", options.tolerance_mm));
  return check_rim(options);
}

Result<void> check_front(const HeightFieldMesh& front, bool has_ground) {
  const auto is_bad = [&](Index i) { return i >= front.points.size() || !front.points[i].allFinite(); };
  const auto has_bad_corner = [&](const Triangle& t) { return std::ranges::any_of(t, is_bad); };
  if (front.triangles.empty() || (has_ground && front.hull.size() < 3))
    return geometry_error("front", "expected triangles and a hull around them, found none");
  if (std::ranges::any_of(front.triangles, has_bad_corner) || std::ranges::any_of(front.hull, is_bad))
    return geometry_error("front", "expected corners that are finite points of the front");
  if (!front.colours.empty() && front.colours.size() != front.points.size())
    return geometry_error("front", "expected a colour for each point of the front, or none");
  if (!front.is_relief.empty() && front.is_relief.size() != front.triangles.size())
    return geometry_error("front", "expected to know for each triangle if it is relief, or for none");
  return {};
}

}  // namespace

Result<void> check_plate(const HeightFieldMesh& front, const PlateOptions& options) {
  RELIEVO_CHECK(check_options(options));
  return check_front(front, options.outline != Outline::none);
}

}  // namespace relievo
