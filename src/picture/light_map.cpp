#include "picture/light_map.h"

#include <algorithm>
#include <cmath>

#include "blur.h"
#include "relievo/core/parallel.h"

namespace relievo {
namespace {

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

// The way from a pixel to the lamp, step by step.
struct Ray {
  float x, y;  // of a step, in pixels
  float rise;  // of a step, in mm
};

Ray ray_to(const HeightField& field, const Vec3& to_lamp) {
  const double step_px = 1.5, flat = to_lamp.head<2>().norm();
  return {static_cast<float>(step_px * to_lamp.x() / flat), static_cast<float>(-step_px * to_lamp.y() / flat),
          static_cast<float>(step_px * field.mm_per_pixel * to_lamp.z() / flat)};
}

// Share of a wide lamp seen from a pixel: walks towards it as long as the relief can still rise above the
// ray.
float lamp_share(const HeightField& field, int column, int row, const Ray& ray, float highest) {
  const float lamp_width = 0.7F;  // tangent of the lamp's apparent size: the softness of shadows
  const float x = static_cast<float>(column) + .5F, y = static_cast<float>(row) + .5F;
  const auto width = static_cast<float>(field.width), height = static_cast<float>(field.height);
  const float* const heights = field.z.data();
  const float z = heights[row * field.width + column];
  float hidden = 0, steps = 2;
  for (; z + steps * ray.rise * (1 - lamp_width) < highest; ++steps) {
    const float at_x = x + steps * ray.x, at_y = y + steps * ray.y;
    if (!(at_x >= 0 && at_y >= 0 && at_x < width && at_y < height)) break;
    const float rise = steps * ray.rise;
    const float above = heights[static_cast<int>(at_y) * field.width + static_cast<int>(at_x)] - (z + rise);
    hidden = std::max(hidden, above / (rise * lamp_width) + 0.5F);
    if (hidden >= 1) break;
  }
  const float darkest = 0.7F;  // light from the room brightens a studio's shadows
  return 1 - darkest * std::min(1.F, hidden);
}

void hide_lamp(const HeightField& field, const Vec3& to_lamp, std::vector<Light>& light) {
  if (to_lamp.z() <= 0 || to_lamp.head<2>().norm() < 1e-6) return;
  const Ray ray = ray_to(field, to_lamp);
  const auto highest = static_cast<float>(field.box.size().z());
  const auto columns = static_cast<std::size_t>(field.width);
  const auto hide_row = [&](std::size_t row) {
    for (std::size_t column = 0; column < columns; ++column)
      light[row * columns + column].lamp =
          lamp_share(field, static_cast<int>(column), static_cast<int>(row), ray, highest);
  };
  parallel_for(static_cast<std::size_t>(field.height), hide_row, 8);
}

// Gives the pixels along the front's edge, but beside it, the mean light of their neighbours on it: between
// pixels light is interpolated, and the shadow of the plate's edge must not reach onto the plate.
void light_edge(const HeightField& field, std::vector<Light>& light) {
  const auto at = [&](int column, int row) {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(field.width) +
           static_cast<std::size_t>(column);
  };
  const auto mean_around = [&](int column, int row) {
    Light sum;
    float count = 0;
    for (int y = std::max(0, row - 1); y <= std::min(field.height - 1, row + 1); ++y)
      for (int x = std::max(0, column - 1); x <= std::min(field.width - 1, column + 1); ++x) {
        if (field.is_beside[at(x, y)]) continue;
        sum.lamp += light[at(x, y)].lamp, sum.sky += light[at(x, y)].sky;
        ++count;
      }
    return count > 0 ? Light{sum.lamp / count, sum.sky / count} : Light{1, 1};
  };
  const auto light_row = [&](std::size_t r) {
    const int row = static_cast<int>(r);
    for (int column = 0; column < field.width; ++column)
      if (field.is_beside[at(column, row)]) light[at(column, row)] = mean_around(column, row);
  };
  if (!field.is_beside.empty()) parallel_for(static_cast<std::size_t>(field.height), light_row, 8);
}

}  // namespace

LightMap::LightMap(const Solid& solid, const Vec3& to_lamp, int longer_side_px)
    : LightMap(draw_height_field(solid, longer_side_px), to_lamp) {}

LightMap::LightMap(HeightField field, const Vec3& to_lamp)
    : field_(std::move(field)), light_(field_.z.size(), Light{1, 1}) {
  if (light_.empty()) return;
  pixels_per_mm_ = static_cast<float>(1 / field_.mm_per_pixel);
  const Vec2 origin = field_.to_pixels(Vec3::Zero()) - Vec2::Constant(0.5);
  origin_ = origin.cast<float>();
  const int longer_side_px = std::max(field_.width, field_.height);
  hide_sky(field_, std::max(1, longer_side_px / 120), light_);
  hide_sky(field_, std::max(1, longer_side_px / 30), light_);
  hide_lamp(field_, to_lamp, light_);
  light_edge(field_, light_);
}

Light LightMap::at(const Vec3f& point) const {
  if (light_.empty()) return {1, 1};
  const float x =
      std::clamp(origin_.x() + pixels_per_mm_ * point.x(), 0.F, static_cast<float>(field_.width - 1));
  const float y =
      std::clamp(origin_.y() - pixels_per_mm_ * point.y(), 0.F, static_cast<float>(field_.height - 1));
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
