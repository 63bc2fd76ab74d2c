#include "relief/aimed_slopes.h"

#include "core/angle.h"
#include "relievo/core/text.h"
#include "relievo/scan/surface.h"
#include "scan/surface_blur.h"

namespace relievo {

Result<LightDirection> parse_light(std::string_view text) {
  const std::vector<double> angles = parse_numbers(text).value_or(std::vector<double>());
  const bool is_in_range =
      angles.size() == 2 && std::abs(angles[0]) <= 360 && angles[1] >= 5 && angles[1] <= 85;
  if (is_in_range) return LightDirection{angles[0], angles[1]};
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
  std::vector<float> contrast(surface.normals.size());
  parallel_for(contrast.size(),
               [&](std::size_t i) { contrast[i] = std::max(surface.normals[i].dot(l), 0.F); });
  const std::vector<float> mean = blurred(surface.points, contrast, width * surface.longer_side());
  parallel_for(contrast.size(), [&](std::size_t i) { contrast[i] -= mean[i]; });
  return contrast;
}

}  // namespace relievo
