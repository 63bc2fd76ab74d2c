#include "relief/aimed_slopes.h"

#include "core/angle.h"
#include "core/number.h"
#include "relievo/core/text.h"
#include "relievo/scan/surface.h"
#include "scan/surface_blur.h"

namespace relievo {

Result<LightDirection> parse_light(std::string_view text) {
  const std::size_t comma = std::min(text.find(','), text.size());
  const auto number = [](std::string_view part) -> std::optional<double> {
    const auto [value, end, failed] = parse_double(part);
    if (failed != std::errc() || end != part.data() + part.size()) return std::nullopt;
    return value;
  };
  const auto azimuth = number(text.substr(0, comma)),
             elevation = number(text.substr(std::min(comma + 1, text.size())));
  const bool is_in_range =
      azimuth && elevation && std::abs(*azimuth) <= 360 && *elevation >= 5 && *elevation <= 85;
  if (is_in_range) return LightDirection{*azimuth, *elevation};
  return option_error(
      "light", cat("expected azimuth from -360 to 360 and elevation from 5 to 85 degrees, such as 135,30, "
                   "found '",
                   text, "'"));
}

Vec3 direction_of(const LightDirection& light) {
  const double azimuth = to_radians(light.azimuth_deg), elevation = to_radians(light.elevation_deg);
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
          std::sin(elevation)};
}

std::vector<float> local_contrast(const Surface& surface, const LightDirection& light) {
  constexpr double width = .03;  // standard deviation, as a share of the longer side
  const Vec3f l = direction_of(light).cast<float>();
  std::vector<Vec2f> shading(surface.normals.size());
  parallel_for(shading.size(),
               [&](std::size_t i) { shading[i] = Vec2f(std::max(surface.normals[i].dot(l), 0.F), 0); });
  std::vector<Vec2f> mean = shading;
  SurfaceBlur(surface.points, width * surface.longer_side()).apply(mean);
  std::vector<float> contrast(shading.size());
  parallel_for(contrast.size(), [&](std::size_t i) { contrast[i] = shading[i].x() - mean[i].x(); });
  return contrast;
}

}  // namespace relievo
