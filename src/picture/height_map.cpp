#include <algorithm>

#include "plate/height_field.h"
#include "relievo/picture/height_map.h"

namespace relievo {

HeightMap make_height_map(const Solid& solid, int longer_side_px) {
  const HeightField field = measure_height_field(solid, longer_side_px);
  const double span_mm = field.box.size().z();
  HeightMap map{{}, field.mm_per_pixel, span_mm / 65535};
  map.image.resize(field.z.width, field.z.height);
  const double greys_per_mm = span_mm > 0 ? 65535 / span_mm : 0;
  std::ranges::transform(field.z.pixels, map.image.pixels.begin(),
                         [&](float z) { return static_cast<std::uint16_t>(z * greys_per_mm + 0.5); });
  return map;
}

HeightsMm make_heights_mm(const Solid& solid, int longer_side_px) {
  HeightField field = measure_height_field(solid, longer_side_px);
  return {std::move(field.z), field.mm_per_pixel, {}};
}

}  // namespace relievo
