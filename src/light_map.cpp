#include "light_map.h"

#include <algorithm>
#include <cmath>

#include "blur.h"
#include "relievo/parallel.h"

namespace relievo {
namespace {

float height_at(const HeightField& field, const Vec2& place) {
  const int x = std::clamp(static_cast<int>(place.x()), 0, field.width - 1);
  const int y = std::clamp(static_cast<int>(place.y()), 0, field.height - 1);
  return field
      .z[static_cast<std::size_t>(y) * static_cast<std::size_t>(field.width) + static_cast<std::size_t>(x)];
}

// Darkens the sky where the surface lies below its surroundings within about `radius` pixels (after Luft,
// Colditz and Deussen, Image Enhancement by Unsharp Masking the Depth Buffer, 2006).
void hide_sky(const HeightField& field, int radius, std::vector<Light>& light) {
  std::vector<float> mean = field.z;
  blur(mean, field.width, radius);
  const float strength = 2.2F / static_cast<float>(radius * field.mm_per_pixel), darkest = 0.2F;
  parallel_for(mean.size(), [&](std::size_t i) {
    const float open = std::exp(-strength * std::max(0.F, mean[i] - field.z[i]));
    light[i].sky *= darkest + (1 - darkest) * open;
  });
}

// Share of a wide lamp seen from a pixel: walks towards it as long as the relief can still rise above the
// ray.
float lamp_share(const HeightField& field, const Vec2& from, const Vec3& to_lamp) {
  const double step_px = 1.5;
  const double flat = to_lamp.head<2>().norm();
  const Vec2 step = step_px * Vec2(to_lamp.x(), -to_lamp.y()) / flat;
  const double rise = step_px * field.mm_per_pixel * to_lamp.z() / flat;
  const double lamp_width = 0.7;  // tangent of the lamp's apparent size: the softness of shadows
  const double z = height_at(field, from), highest = field.box.size().z();
  double hidden = 0;
  for (int i = 2; z + i * rise * (1 - lamp_width) < highest; ++i) {
    const Vec2 place = from + i * step;
    if (place.x() < 0 || place.y() < 0 || place.x() >= field.width || place.y() >= field.height) break;
    const double above = height_at(field, place) - (z + i * rise);
    hidden = std::max(hidden, above / (i * rise * lamp_width) + 0.5);
    if (hidden >= 1) break;
  }
  const double darkest = 0.7;  // light from the room brightens a studio's shadows
  return static_cast<float>(1 - darkest * std::min(1.0, hidden));
}

void hide_lamp(const HeightField& field, const Vec3& to_lamp, std::vector<Light>& light) {
  if (to_lamp.z() <= 0 || to_lamp.head<2>().norm() < 1e-6) return;
  parallel_for(
      static_cast<std::size_t>(field.height),
      [&](std::size_t row) {
        for (int column = 0; column < field.width; ++column) {
          const Vec2 centre(column + 0.5, static_cast<double>(row) + 0.5);
          light[row * static_cast<std::size_t>(field.width) + static_cast<std::size_t>(column)].lamp =
              lamp_share(field, centre, to_lamp);
        }
      },
      8);
}

}  // namespace

LightMap::LightMap(const Solid& solid, const Vec3& to_lamp, int longer_side_px)
    : LightMap(draw_height_field(solid, longer_side_px), to_lamp) {}

LightMap::LightMap(HeightField field, const Vec3& to_lamp)
    : field_(std::move(field)), light_(field_.z.size(), Light{1, 1}) {
  if (light_.empty()) return;
  const int longer_side_px = std::max(field_.width, field_.height);
  hide_sky(field_, std::max(1, longer_side_px / 120), light_);
  hide_sky(field_, std::max(1, longer_side_px / 30), light_);
  hide_lamp(field_, to_lamp, light_);
}

Light LightMap::at(const Vec3& point) const {
  if (light_.empty()) return {1, 1};
  const Vec2 place = field_.to_pixels(point) - Vec2::Constant(0.5);
  const float x = std::clamp(static_cast<float>(place.x()), 0.F, static_cast<float>(field_.width - 1));
  const float y = std::clamp(static_cast<float>(place.y()), 0.F, static_cast<float>(field_.height - 1));
  const int left = static_cast<int>(x), top = static_cast<int>(y);
  const int right = std::min(left + 1, field_.width - 1), bottom = std::min(top + 1, field_.height - 1);
  const auto pixel = [&](int column, int row) {
    return light_[static_cast<std::size_t>(row) * static_cast<std::size_t>(field_.width) +
                  static_cast<std::size_t>(column)];
  };
  const auto mix = [](const Light& a, const Light& b, float t) {
    return Light{a.lamp + t * (b.lamp - a.lamp), a.sky + t * (b.sky - a.sky)};
  };
  const float s = x - static_cast<float>(left), t = y - static_cast<float>(top);
  return mix(mix(pixel(left, top), pixel(right, top), s), mix(pixel(left, bottom), pixel(right, bottom), s),
             t);
}

}  // namespace relievo
