// Draws the images of a model with which reliefs are compared: its normals and depths, and the pixels to measure.
#pragma once

#include <span>

#include "quality/image_measures.h"
#include "relievo/core/image.h"
#include "relievo/scan/surface.h"

namespace relievo {
// The triangle that covers each pixel's centre, and the weights of its corners there. It depends only on the
// positions of points in the view plane, so it serves for the pictures of all reliefs of a surface.
class BarycentricMap {
 public:
  // The longer side of the points' box gets `longer_side_px` pixels. Each side of the picture gets a margin of
  // `margin_px`.
  BarycentricMap(std::span<const Vec3> points, const Triangulation& triangulation, int longer_side_px,
                 int margin_px);

  int width() const { return places_.width; }
  int height() const { return places_.height; }
  std::size_t pixels() const { return places_.size(); }
  double units_per_pixel() const { return units_per_pixel_; }

  // Returns the position of a point in the picture: x to the right, y down, the first pixel's centre at
  // (0.5, 0.5).
  Vec2 to_pixels(const Vec3& point) const {
    const Vec3 p = (point - centre_) / units_per_pixel_;
    return {width() / 2.0 + p.x(), height() / 2.0 - p.y()};
  }

  // Returns the triangle at a pixel; no_index outside the hull.
  Index triangle(std::size_t pixel) const { return places_[pixel].triangle; }

  // Returns value(point) interpolated at a pixel; `outside` where there is no triangle.
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

  double units_per_pixel_ = 0;
  Vec3 centre_ = Vec3::Zero();
  Image<Place> places_;
};

struct NormalMap {
  Image<float> x, y, z;
};

// Returns the normals of a height field whose heights are in pixels, by central differences. At the picture's border
// the normals are (0, 0, 1).
NormalMap normals_of(const Image<float>& z);

// Images of the model's own normals and depths. Outside the relief, the normals are (0, 0, 1).
struct ModelPicture {
  // The least distance of measured pixels from silhouette and jumps; also the radius of SSIM's window.
  static constexpr int safe_distance_px = 5;

  BarycentricMap grid;
  std::vector<std::uint8_t> is_inside;  // per pixel: whether it is on the relief
  PixelMask measured;                   // the pixels at least safe_distance_px away from silhouette and jumps
  NormalMap normals;
  Image<float> depth;

  ModelPicture(const Surface& surface, int longer_side_px, int margin_px);

  int width() const { return grid.width(); }

  // Returns the picture of heights, with one height per point of the surface. The unit of the result is a pixel.
  Image<float> heights_in_pixels(std::span<const double> heights) const;

 private:
  void classify(const Surface& surface);
  void draw(const Surface& surface);
};

}  // namespace relievo
