// A model drawn for reliefs to be measured against it: its normals and depths, and where to look.
#pragma once

#include "quality/plane_measures.h"

namespace relievo {

struct NormalPicture {
  Plane x, y, z;
};

// The normals of heights in pixels by central differences, level at the picture's rim.
NormalPicture normals_of(const Plane& z, int width);

// The model as the scan's own normals and depths say, level outside.
struct ModelPicture {
  static constexpr int safe_distance_px = 5;  // from silhouette and jumps; the reach of SSIM's window, too

  PictureGrid grid;
  std::vector<std::uint8_t> is_inside;  // per pixel: on the relief
  Measured measured;                    // at the safe distance
  NormalPicture normals;
  Plane depth;

  ModelPicture(const Surface& surface, int longer_side_px, int margin_px);

  int width() const { return grid.width(); }

  // Draws heights, one per point, in pixels.
  Plane heights_in_pixels(std::span<const double> heights) const;

 private:
  void classify(const Surface& surface);
  void draw(const Surface& surface);
};

}  // namespace relievo
