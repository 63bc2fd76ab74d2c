// A surface's points on the pixels of a picture, and filters on pictures.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "relievo/scan/surface.h"

namespace relievo {

using Plane = std::vector<float>;  // one value per pixel, row-major, first row at the top

// The triangle that covers each pixel's centre, and the weights of its corners there. It depends on where the
// points are in the plane alone, so that pictures of many reliefs of one surface are drawn with it.
class PictureGrid {
 public:
  // The longer side of the points' box gets `longer_side_px` pixels, with `margin_px` more on each side.
  PictureGrid(std::span<const Vec3> points, const Triangulation& triangulation, int longer_side_px,
              int margin_px);

  int width() const { return width_; }
  int height() const { return height_; }
  std::size_t pixels() const { return places_.size(); }
  double units_per_pixel() const { return units_per_pixel_; }

  // Where a point lies in the picture: x to the right, y down, the first pixel's centre at (0.5, 0.5).
  Vec2 to_pixels(const Vec3& point) const {
    const Vec3 p = (point - centre_) / units_per_pixel_;
    return {width_ / 2.0 + p.x(), height_ / 2.0 - p.y()};
  }

  // no_index where the pixel is outside the hull.
  Index triangle(std::size_t pixel) const { return places_[pixel].triangle; }

  // Values given per point, interpolated; `outside` where no triangle is.
  template <typename Value>
  float at(std::size_t pixel, Value&& value, float outside) const {
    const Place& p = places_[pixel];
    if (p.triangle == no_index) return outside;
    return p.weights[0] * value(p.corners[0]) + p.weights[1] * value(p.corners[1]) +
           p.weights[2] * value(p.corners[2]);
  }

 private:
  struct Place {
    Index triangle = no_index;
    Triangle corners{};
    Vec3f weights = Vec3f::Zero();
  };

  int width_ = 0, height_ = 0;
  double units_per_pixel_ = 0;
  Vec3 centre_ = Vec3::Zero();
  std::vector<Place> places_;
};

// A Gaussian of that standard deviation in pixels, cut at `reach` pixels. The border continues outside.
class GaussianFilter {
 public:
  GaussianFilter(double sigma, int reach);
  void apply(Plane& plane, int width) const;

 private:
  std::vector<float> weights_;  // of the centre and of each distance from it
};

// 1 where some pixel of the square of 2 `reach` + 1 pixels around is not 0.
std::vector<std::uint8_t> widened(const std::vector<std::uint8_t>& mask, int width, int reach);

}  // namespace relievo
