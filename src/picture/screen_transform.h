// Maps the points of a body to positions in a picture.
#pragma once

#include <algorithm>

#include "relievo/core/types.h"

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

}  // namespace relievo
