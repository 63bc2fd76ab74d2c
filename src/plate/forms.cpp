#include "relievo/plate/forms.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

#include "core/quantile.h"
#include "core/srgb.h"
#include "relievo/core/parallel.h"
#include "relievo/plate/solid.h"
#include "relievo/scan/surface.h"
#include "scan/depth/flat_picture.h"

namespace relievo {
namespace {

// The plate is thinnest where the brightness is at least its quantile `bright_share`; if only the brightest
// point counted, a few highlights would leave everything else dark. The plate is thickest where the
// brightness is at most its quantile `dark_share`. This second brightness is kept between
// `least_dark_of_bright` and `dark_of_bright` times the first one.
constexpr double bright_share = .98, dark_share = .1;
constexpr double dark_of_bright = .1, least_dark_of_bright = 1e-3;

// Returns the brightness of a white surface under a large lamp at the upper left. Light reaches surfaces that
// face away from the lamp, so that their shape stays visible.
double shade(const Vec3f& normal) {
  const Vec3f lamp = Vec3f(-1, 1, 1.6F).normalized();
  const double facing = .5 + .5 * static_cast<double>(normal.dot(lamp));
  return .1 + .9 * facing * facing;
}

struct Range {
  double darkest, brightest;
};

// Returns the brightnesses at which the plate is thickest and thinnest. Points on the outline are ignored.
Range range_of(std::span<const double> bright, std::span<const std::uint8_t> is_boundary) {
  std::vector<double> inside;
  for (std::size_t i = 0; i < bright.size(); ++i)
    if (!is_boundary[i]) inside.push_back(bright[i]);
  if (inside.empty()) return {0, 0};
  const double brightest = quantile(inside, bright_share), dark = quantile(inside, dark_share);
  return {std::clamp(dark, least_dark_of_bright * brightest, dark_of_bright * brightest), brightest};
}

// Returns the darkness: 0 for the brightest points, 1 for the darkest. In between it is linear in the
// logarithm of the brightness.
double darkness(double bright, const Range& range) {
  if (!(range.brightest > 0)) return 1;
  const double within = std::clamp(bright, range.darkest, range.brightest);
  return std::log(within / range.brightest) / std::log(range.darkest / range.brightest);
}

// Returns the darkness of a pixel: 0 for white, 1 for black.
double darkness_of_pixel(const Colour& colour) {
  return 1 - (.2126 * colour[0] + .7152 * colour[1] + .0722 * colour[2]) / 255;
}

// Returns the darkness of each point of a surface under the lamp.
std::vector<double> darkness_of_model(const Surface& surface) {
  std::vector<double> values(surface.points.size());
  parallel_for(values.size(), [&](std::size_t i) {
    values[i] = shade(surface.normals[i]) * (surface.colours.empty() ? 1 : luminance(surface.colours[i]));
  });
  const Range range = range_of(values, surface.boundary.is_boundary);
  parallel_for(values.size(), [&](std::size_t i) { values[i] = darkness(values[i], range); });
  return values;
}

}  // namespace

HeightFieldMesh mirrored(HeightFieldMesh front) {
  for (Vec3& p : front.points) p.x() = -p.x();
  for (Triangle& t : front.triangles) std::swap(t[1], t[2]);
  std::ranges::reverse(front.hull);
  return front;
}

HeightFieldMesh as_die(HeightFieldMesh front) {
  for (Vec3& p : front.points) p.z() = -p.z();
  front.ground_mm = -front.ground_mm;
  return mirrored(std::move(front));
}

HeightFieldMesh lithophane(const Surface& surface, double mm_per_unit, double height_mm) {
  const bool is_picture = is_flat_picture(surface);
  std::vector<double> share;
  if (is_picture)
    std::ranges::transform(surface.colours, std::back_inserter(share), darkness_of_pixel);
  else
    share = darkness_of_model(surface);
  HeightFieldMesh front{std::vector<Vec3>(share.size()), surface.triangulation.triangles,
                        surface.triangulation.hull, height_mm};
  if (!is_picture) front.colours = surface.colours;
  parallel_for(share.size(), [&](std::size_t i) {
    const Vec2 place = mm_per_unit * surface.points[i].head<2>();
    front.points[i] = {place.x(), place.y(), height_mm * (surface.boundary.is_boundary[i] ? 1 : share[i])};
  });
  return front;
}

}  // namespace relievo
