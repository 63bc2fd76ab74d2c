// Renders bodies, for previews, live pictures and comparisons.
#pragma once

#include <algorithm>
#include <memory>
#include <optional>

#include "geometry/raster.h"
#include "picture/body.h"
#include "plate/height_field.h"
#include "relievo/core/image.h"
#include "relievo/core/progress.h"
#include "relievo/core/types.h"
#include "relievo/picture/material.h"
#include "relievo/plate/tool.h"

namespace relievo {

// An orthographic projection of a body. The position in the picture is its centre + pixels_per_mm *
// R_screen_body * (point - pan), with y downwards.
struct ScreenTransform {
  // Points are clamped to this distance from the picture's centre, in pixels. Otherwise the rasteriser's
  // integers could overflow.
  static constexpr double farthest_px = 100000;

  int width = 0, height = 0;
  double pixels_per_mm = 1;
  Mat3 R_screen_body = Mat3::Identity();
  Vec3 pan = Vec3::Zero();
  bool is_front = true;  // whether R_screen_body is the identity

  Vec3 to_screen(const Vec3& point) const {
    const Vec3 p = pixels_per_mm * (R_screen_body * (point - pan));
    return {width / 2.0 + std::clamp(p.x(), -farthest_px, farthest_px),
            height / 2.0 - std::clamp(p.y(), -farthest_px, farthest_px), p.z()};
  }

  // Returns the point of the body at a position in the picture. In the front view the z of the point is
  // unknown and set to 0.
  Vec3f to_body(double x, double y, double z) const {
    if (is_front)
      return {static_cast<float>((x - width / 2.0) * (1 / pixels_per_mm) + pan.x()),
              static_cast<float>((height / 2.0 - y) * (1 / pixels_per_mm) + pan.y()), 0};
    const Vec3 p = Vec3(x - width / 2.0, height / 2.0 - y, z) / pixels_per_mm;
    return (R_screen_body.transpose() * p + pan).cast<float>();
  }

  Vec3f to_viewer() const { return R_screen_body.row(2).transpose().cast<float>(); }

  // Returns the transform for the same picture with `times` as many pixels along each side.
  ScreenTransform finer(int times) const {
    ScreenTransform out = *this;
    out.width *= times;
    out.height *= times;
    out.pixels_per_mm *= times;
    return out;
  }

  bool operator==(const ScreenTransform&) const = default;
};

// A point on a triangle, given by barycentric weights in units of 1/65535. The third weight is 1 minus the
// sum of the other two.
struct VisiblePoint {
  // The corners are stored with the point, because looking them up would make live pictures a third slower.
  Triangle corners = {no_index, no_index, no_index};
  Index triangle = no_index;
  std::uint16_t first = 0, second = 0;
  float z = 0;  // height towards the viewer, in pixels
  Part part = Part::nothing;

  // Returns the mean of values at the three corners, weighted by the barycentric weights.
  template <typename T>
  T mean(const T& a, const T& b, const T& c) const {
    const float s = static_cast<float>(first) / 65535, t = static_cast<float>(second) / 65535;
    return s * a + t * b + (1 - s - t) * c;
  }
};

using VisibilityBuffer = Image<VisiblePoint>;

// Returns the body's triangles in pixels of the picture. For a height field seen from above, the result has no heights.
RasterInput raster_input(const DrawnBody& body, const ScreenTransform& transform);

// Returns the point of a triangle of the body at position `place` in the picture.
VisiblePoint visible_point(const DrawnBody& body, const RasterInput& input, Index triangle,
                           const Vec3f& place);

// Overwrites the buffer with the visible points at the centres of the picture's pixels.
void draw_visibility(const DrawnBody& body, const RasterInput& input, VisibilityBuffer& buffer);

// Returns the height of a point above the ground, in mm.
float height_mm(const DrawnBody& body, const VisiblePoint& seen);

// Caches a visibility buffer. The buffer is used again if the body is a height field that is seen from above,
// and neither the plate's size nor the transform has changed. Heights may have changed.
class CachedVisibility {
 public:
  const VisibilityBuffer& get(const DrawnBody& body, const ScreenTransform& transform);

 private:
  struct Key {
    ScreenTransform transform;
    double mm_per_place = 0;
    Vec2 corner;  // corner of the plate
    bool operator==(const Key&) const = default;
  };
  VisibilityBuffer buffer_;
  std::optional<Key> key_;
};

struct DrawParams {
  Material material = Material::plaster;
  Vec3f light = upper_left_lamp;  // direction to the lamp, in the axes of the plate
  bool has_shadows = true;
  bool is_fine = false;                         // more samples per pixel, and finer shadows
  std::shared_ptr<const ToolReach> reach = {};  // colours material that the tool leaves
  const Progress* progress = nullptr;           // if cancelled, the picture stays unfinished
};

// Visibility buffers that can be reused for pictures of the same body, if it is a height field.
struct DrawCache {
  CachedVisibility front, quick_light, fine_light;
};

// Overwrites the picture (4 channels) with the body and its drop shadow on a transparent background. The same
// body, transform and parameters give the same pixels for any number of threads, whatever was drawn before.
void draw_body(const DrawnBody& body, const ScreenTransform& transform, const DrawParams& params,
               DrawCache& cache, Image8& picture);

// Returns the heights of the body's front above its lowest point. `longer_side_px` is the longer side of the result.
HeightField front_heights(const DrawnBody& body, int longer_side_px, CachedVisibility& cache);

}  // namespace relievo
