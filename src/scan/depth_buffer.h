// A depth buffer that points are splatted into as oriented discs.
#pragma once

#include <vector>

#include "relievo/core/types.h"

namespace relievo {

// A flat disc in view coordinates.
struct Disc {
  Vec3 centre;
  Vec3f normal;  // unit length; the disc is seen by its projection
  double radius = 0;
};

class DepthBuffer {
 public:
  // Covers the box's x and y with square pixels of about the given side; larger ones where that would be more
  // than `most_pixels`.
  DepthBuffer(const Box& box, double pixel);

  // Raises the depth at each pixel whose centre a disc covers to the disc's, if that is nearer. Depths before
  // are -inf.
  void splat(const std::vector<Disc>& discs);

  // Depth at the pixel that holds (x, y), -inf where no disc lies or outside the box.
  float depth(double x, double y) const;

  // Centre of that pixel.
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

// Change of depth from a disc's centre to the point of its plane at (dx, dy) from it. Slopes are limited so
// that discs seen edge on stay finite.
double depth_along_plane(const Vec3f& normal, double dx, double dy);

}  // namespace relievo
