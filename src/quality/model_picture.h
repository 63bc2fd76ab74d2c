// Images of a model against which reliefs are measured: its normals and depths, and the pixels to measure.
#pragma once

#include "quality/barycentric_map.h"
#include "quality/image_measures.h"

namespace relievo {

struct NormalMap {
  Image<float> x, y, z;
};

// Returns the normals of heights in pixels by central differences, level at the picture's rim.
NormalMap normals_of(const Image<float>& z);

// Images of the scan's own normals and depths, level outside the relief.
struct ModelPicture {
  static constexpr int safe_distance_px = 5;  // from silhouette and jumps; also the radius of SSIM's window

  BarycentricMap grid;
  std::vector<std::uint8_t> is_inside;  // per pixel: on the relief
  PixelMask measured;                   // at the safe distance
  NormalMap normals;
  Image<float> depth;

  ModelPicture(const Surface& surface, int longer_side_px, int margin_px);

  int width() const { return grid.width(); }

  // Draws heights, one per point, in pixels.
  Image<float> heights_in_pixels(std::span<const double> heights) const;

 private:
  void classify(const Surface& surface);
  void draw(const Surface& surface);
};

}  // namespace relievo
