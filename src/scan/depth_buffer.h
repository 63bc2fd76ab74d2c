// Draws points as oriented discs into a depth buffer. Tested by tests/scan/visible_test.cpp.
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

  // Removes the discs `gone`; `rest` are all others that were drawn. The buffer is divided into squares of pixels.
  // Each square that a removed disc touches is cleared, and the remaining discs that touch it are drawn again.
  void take_away(const std::vector<Disc>& gone, const std::vector<Disc>& rest);

  // Returns whether take_away() has redrawn the pixel that contains (x, y). The position must lie in the box.
  bool is_redrawn(double x, double y) const { return is_redrawn_[square(column(x), row(y))] != 0; }

  // Returns the depth of the pixel that contains (x, y); -infinity where there is no disc, or outside the
  // box.
  float depth(double x, double y) const;

  Vec2 pixel_centre(double x, double y) const;

 private:
  static constexpr double most_pixels = 64e6;
  static constexpr long square_side = 8;
  struct Pixels {
    long c0, c1, r0, r1;
  };
  Pixels pixels_of(const Disc& disc) const;
  std::size_t square(long column, long row) const {
    return static_cast<std::size_t>(row / square_side * squares_ + column / square_side);
  }
  long column(double x) const;
  long row(double y) const;
  void splat_into_rows(const Disc& disc, long first_row, long last_row);

  Vec2 origin_;
  double pixel_;
  long columns_, rows_, squares_;  // squares_: squares of pixels in a row of squares
  std::vector<float> depth_;
  std::vector<std::uint8_t> is_redrawn_;  // per square of pixels
};

// Returns how much higher the disc's plane is at the offset (dx, dy) than at the disc's centre. Slopes are
// limited to 20, so that the result is finite for discs seen edge-on.
double depth_along_plane(const Vec3f& normal, double dx, double dy);

}  // namespace relievo
