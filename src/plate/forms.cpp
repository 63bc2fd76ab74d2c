#include "relievo/plate/forms.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "relievo/core/parallel.h"

namespace relievo {
namespace {

constexpr double darkest = .1;  // brightness at which the plate is thickest

// Relative luminance of what the eye sees, of sRGB colours.
double luminance(const Colour& colour) {
  const auto linear = [](std::uint8_t value) {
    const double v = value / 255.0;
    return v <= .04045 ? v / 12.92 : std::pow((v + .055) / 1.055, 2.4);
  };
  return .2126 * linear(colour[0]) + .7152 * linear(colour[1]) + .0722 * linear(colour[2]);
}

double shade(const Vec3f& normal) {
  const Vec3f lamp = Vec3f(-1, 1, 1.6F).normalized();
  const double facing = std::max(0.F, normal.dot(lamp));
  return .25 + .75 * facing;  // what faces away still shows its form
}

}  // namespace

Result<Form> parse_form(std::string_view name) {
  constexpr std::array<std::string_view, 4> names = {"relief", "mirror", "die", "lithophane"};
  const auto found = std::ranges::find(names, name);
  if (found != names.end()) return static_cast<Form>(found - names.begin());
  return std::unexpected(
      Error{ErrorKind::option,
            "--form",
            {},
            "expected relief, mirror, die or lithophane, found '" + std::string(name) + "'"});
}

Front mirrored(Front front) {
  for (Vec3& p : front.points) p.x() = -p.x();
  for (Triangle& t : front.triangles) std::swap(t[1], t[2]);
  std::ranges::reverse(front.hull);
  return front;
}

Front as_die(Front front) {
  for (Vec3& p : front.points) p.z() = -p.z();
  front.ground_mm = -front.ground_mm;
  return mirrored(std::move(front));
}

Front lithophane(const Surface& surface, double mm_per_unit, double height_mm) {
  std::vector<double> bright(surface.points.size());
  parallel_for(bright.size(), [&](std::size_t i) {
    bright[i] = shade(surface.normals[i]) * (surface.colours.empty() ? 1 : luminance(surface.colours[i]));
  });
  const double brightest = *std::ranges::max_element(bright);
  Front front{std::vector<Vec3>(bright.size()), surface.triangulation.triangles, surface.triangulation.hull,
              height_mm, surface.colours};
  parallel_for(bright.size(), [&](std::size_t i) {
    const bool is_dark = surface.boundary.is_boundary[i] || !(brightest > 0);
    const double share = is_dark ? darkest : std::clamp(bright[i] / brightest, darkest, 1.0);
    const Vec2 place = mm_per_unit * surface.points[i].head<2>();
    front.points[i] = {place.x(), place.y(), height_mm * std::log(share) / std::log(darkest)};
  });
  return front;
}

}  // namespace relievo
