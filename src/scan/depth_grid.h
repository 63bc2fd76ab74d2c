// A depth image as a grid of heights, before the heights become points: each has bounds, between which it can
// be smoothed. Tested by tests/scan/depth_image_test.cpp.
#pragma once

#include <cstdint>
#include <vector>

#include "relievo/scan/depth_image.h"

namespace relievo {

// A row-major grid. Bounds count only where `is_known` is set, connections only between two known points.
struct BoundedGrid {
  int width = 0, height = 0;
  std::vector<float> low, high;
  std::vector<std::uint8_t> is_known;
  std::vector<std::uint8_t> joins_right, joins_down;  // no depth jump between this point and that neighbour

  std::size_t at(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column);
  }
};

// Returns the smoothest heights with low <= z <= high at all known points, 0 at unknown ones. Smoothest means
// that the sum of squared second differences (along rows, along columns, and twice the mixed one), over
// joined points, is nearly minimal. Solves from coarse to fine grids in linear time: 2 s for a million points
// on two cores.
std::vector<float> smoothest(const BoundedGrid& grid);

// Heights towards the viewer, in pixels of the reduced grid, each with an interval that contains it.
struct DepthGrid {
  BoundedGrid bounds;         // the intervals in which the heights lie
  std::vector<float> height;  // heights of known grid points
  int reduction = 1;
  double units_per_value = 0;  // see Cloud
  double noise = 0;
  std::size_t missing = 0;
  bool is_sensor = false;  // the steps of the values are coarser than the file's, as from depth cameras
};

// Returns the grid, reduced to about options.points grid points. The bounds account for the step of the
// values and the noise. No grid points are joined yet.
DepthGrid make_grid(const DepthImage& image, const DepthOptions& options);

// Joins neighbouring grid points unless there is a depth jump between them.
void join(DepthGrid& grid);

// Removes the grid points on ramps, which a blurred outline causes between two surfaces. Returns their
// number.
std::size_t cut_ramps(DepthGrid& grid);

// Removes all grid points behind the depth that best separates two groups of depths, if the groups are
// distinct and the far one covers most of the image's border. Returns their number.
std::size_t remove_background(DepthGrid& grid);

}  // namespace relievo
