// A depth buffer into which points are drawn as oriented discs. Tested by tests/scan/visible_test.cpp.
#pragma once

#include <vector>

#include "relievo/core/types.h"

namespace relievo {

// A flat disc in view coordinates.
struct Disc {
  Vec3 centre;
  Vec3f normal;  // unit length
  double radius = 0;
};

class DepthBuffer {
 public:
  // Covers the box's x and y with square pixels of the given width, or with wider ones if there would be more
  // than `most_pixels`. All depths are -infinity.
  DepthBuffer(const Box& box, double pixel);

  // Draws discs. The depth of each pixel whose centre is covered by a disc is raised to the disc's depth
  // there.
  void splat(const std::vector<Disc>& discs);

  // Returns the depth of the pixel that contains (x, y); -infinity where there is no disc and outside the
  // box.
  float depth(double x, double y) const;

  // Returns the centre of the pixel that contains (x, y).
  Vec2 pixel_centre(double x, double y) const;

 private:
  static constexpr double most_pixels = 64e6;
  long column(double x) const;
  long row(double y) const;
  void splat_into_rows(const Disc& disc, long first_row, long last_row);

  Vec2 origin_;
  double pixel_;
  long columns_, rows_;
  std::vector<float> depth_;
};

// Returns how much higher the disc's plane is at the offset (dx, dy) than at the disc's centre. Slopes are
// limited to 20, so that the result is finite for discs seen edge-on.
double depth_along_plane(const Vec3f& normal, double dx, double dy);

}  // namespace relievo
