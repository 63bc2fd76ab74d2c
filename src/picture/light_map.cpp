#include "picture/shading.h"

#include <algorithm>
#include <cmath>

#include "geometry/image_filters.h"
#include "relievo/core/parallel.h"

namespace relievo {
namespace {

// Hollows are darkened at two scales. The radius of a scale is the front's longer side divided by one of
// these numbers. The small radius suits folds and letters. The large radius suits a figure in front of its
// ground.
constexpr int hollow_divisors[] = {120, 30};

// The share of the sky's light in the deepest hollow. Black hollows would look like holes.
constexpr float darkest_hollow = .2F;

// A hollow gets less sky light the deeper it is below the mean height of its surroundings. At this depth, in
// units of the radius of the surroundings, 1/e of the removable sky light is left. The depth corresponds to a
// slope of about 24 degrees, the slope of a distinct fold.
constexpr float hollow_depth = 1 / 2.2F;

// The width of the lamp divided by its distance: a soft box one metre wide, one and a half metres away.
// The shadows of a smaller lamp have edges that look like edges of the relief.
constexpr float lamp_width = .7F;

// The share of the lamp's light that a full shadow removes. The rest represents light reflected by the room.
constexpr float shadow_strength = .7F;

// Length of the steps towards the lamp, in pixels. Longer steps miss narrow ridges; shorter steps find no
// additional ridges.
constexpr double step_px = 1.5;

// Reduces the sky light where the surface is lower than the mean height within about `radius` pixels.
// Source: Luft, Colditz and Deussen, Image Enhancement by Unsharp Masking the Depth Buffer, 2006.
void hide_sky(const HeightField& field, int radius, Image<Light>& light) {
  Image<float> mean = field.z;
  blur(mean, radius);
  const float strength = 1 / (hollow_depth * static_cast<float>(radius * field.mm_per_pixel));
  parallel_for(mean.pixels.size(), [&](std::size_t i) {
    const float open = std::exp(-strength * std::max(0.F, mean.pixels[i] - field.z.pixels[i]));
    light.pixels[i].sky *= darkest_hollow + (1 - darkest_hollow) * open;
  });
}

// The steps of a ray from a pixel towards the lamp.
struct Ray {
  float x, y;  // change per step, in pixels
  float rise;  // change per step, in mm
};

Ray ray_to(const HeightField& field, const Vec3f& to_lamp) {
  const Vec3 lamp = to_lamp.cast<double>();
  const double flat = lamp.head<2>().norm();
  return {static_cast<float>(step_px * lamp.x() / flat), static_cast<float>(-step_px * lamp.y() / flat),
          static_cast<float>(step_px * field.mm_per_pixel * lamp.z() / flat)};
}

// Returns the share of the lamp's light that reaches a pixel. The lamp is extended, so it can be partly
// hidden. The ray is followed as long as the relief may still be higher than the ray.
float lamp_share(const HeightField& field, int column, int row, const Ray& ray, float highest) {
  const float x = static_cast<float>(column) + .5F, y = static_cast<float>(row) + .5F;
  const auto width = static_cast<float>(field.z.width), height = static_cast<float>(field.z.height);
  const float z = field.z.at(column, row);
  float hidden = 0, steps = 2;
  for (; z + steps * ray.rise * (1 - lamp_width) < highest; ++steps) {
    const float at_x = x + steps * ray.x, at_y = y + steps * ray.y;
    if (!(at_x >= 0 && at_y >= 0 && at_x < width && at_y < height)) break;
    const float rise = steps * ray.rise;
    const float above = field.z.at(static_cast<int>(at_x), static_cast<int>(at_y)) - (z + rise);
    hidden = std::max(hidden, above / (rise * lamp_width) + 0.5F);
    if (hidden >= 1) break;
  }
  return 1 - shadow_strength * std::min(1.F, hidden);
}

void hide_lamp(const HeightField& field, const Vec3f& to_lamp, Image<Light>& light) {
  if (to_lamp.z() <= 0 || to_lamp.head<2>().norm() < 1e-6F) return;
  const Ray ray = ray_to(field, to_lamp);
  const auto highest = static_cast<float>(field.box.size().z());
  const auto hide_row = [&](std::size_t r) {
    const int row = static_cast<int>(r);
    for (int column = 0; column < light.width; ++column)
      light.at(column, row).lamp = lamp_share(field, column, row, ray, highest);
  };
  parallel_for(static_cast<std::size_t>(light.height), hide_row, 8);
}

Light mean_light_around(const HeightField& field, const Image<Light>& light, int column, int row) {
  Light sum;
  float count = 0;
  for (int y = std::max(0, row - 1); y <= std::min(light.height - 1, row + 1); ++y)
    for (int x = std::max(0, column - 1); x <= std::min(light.width - 1, column + 1); ++x) {
      if (field.is_beside.at(x, y)) continue;
      sum.lamp += light.at(x, y).lamp, sum.sky += light.at(x, y).sky;
      ++count;
    }
  return count > 0 ? Light{sum.lamp / count, sum.sky / count} : Light{1, 1};
}

// Gives pixels just outside the front the mean light of their neighbours on the front. Otherwise
// interpolation would spread the shadow beside the plate onto the plate.
void light_edge(const HeightField& field, Image<Light>& light) {
  if (field.is_beside.empty()) return;
  const auto light_row = [&](std::size_t r) {
    const int row = static_cast<int>(r);
    for (int column = 0; column < light.width; ++column)
      if (field.is_beside.at(column, row))
        light.at(column, row) = mean_light_around(field, light, column, row);
  };
  parallel_for(static_cast<std::size_t>(light.height), light_row, 8);
}

}  // namespace

LightMap::LightMap(const HeightField& field, const Vec3f& to_lamp)
    : light_(filled_image(field.z.width, field.z.height, Light{1, 1})) {
  if (light_.empty()) return;
  pixels_per_mm_ = static_cast<float>(1 / field.mm_per_pixel);
  origin_ = (field.to_pixels(Vec3::Zero()) - Vec2::Constant(0.5)).cast<float>();
  const int longer_side_px = std::max(light_.width, light_.height);
  for (const int divisor : hollow_divisors) hide_sky(field, std::max(1, longer_side_px / divisor), light_);
  hide_lamp(field, to_lamp, light_);
  light_edge(field, light_);
}

Light LightMap::at(const Vec3f& point) const {
  if (light_.empty()) return {1, 1};
  const float x =
      std::clamp(origin_.x() + pixels_per_mm_ * point.x(), 0.F, static_cast<float>(light_.width - 1));
  const float y =
      std::clamp(origin_.y() - pixels_per_mm_ * point.y(), 0.F, static_cast<float>(light_.height - 1));
  const int left = static_cast<int>(x), top = static_cast<int>(y);
  const int right = std::min(left + 1, light_.width - 1), bottom = std::min(top + 1, light_.height - 1);
  const auto mix = [](const Light& a, const Light& b, float t) {
    return Light{a.lamp + t * (b.lamp - a.lamp), a.sky + t * (b.sky - a.sky)};
  };
  const float s = x - static_cast<float>(left), t = y - static_cast<float>(top);
  return mix(mix(light_.at(left, top), light_.at(right, top), s),
             mix(light_.at(left, bottom), light_.at(right, bottom), s), t);
}

}  // namespace relievo
