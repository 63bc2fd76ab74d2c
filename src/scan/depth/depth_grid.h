// A depth image as a grid of heights, before the heights become points: each has bounds, between which it can
// be smoothed. Tested by tests/scan/depth_image_test.cpp.
#pragma once

#include <cstdint>
#include <vector>

#include "relievo/scan/depth_image.h"
#include "scan/depth/depth_values.h"

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
  BoundedGrid bounds;          // the intervals in which the heights lie
  std::vector<float> height;   // heights of known grid points
  double units_per_value = 0;  // see Cloud
  double noise = 0;
  bool is_sensor = false;   // the steps of the values are coarser than the file's, as from depth cameras
  bool is_terrain = false;  // heights of one surface, whose steepest parts are walls and no depth jumps

  // Returns whether the heights of two known neighbours differ by less than 76 degrees, or by no more than
  // their bounds explain.
  bool is_near(std::size_t i, std::size_t j) const;
};

// A mask of grid points.
using GridMask = std::vector<std::uint8_t>;

// Makes grids of an image, reduced to about options.points grid points.
class GridMaker {
 public:
  GridMaker(const DepthImage& image, const DepthOptions& options);

  int reduction() const { return reduction_; }
  const ValueRange& valid() const { return valid_; }

  // Returns the grid. The bounds account for the step of the values and the noise. The grid points of the
  // mask, none if it is empty, are in the grid, but do not count for the range of depths and for the steps.
  // No grid points are joined yet.
  DepthGrid make(const GridMask& is_left_out) const;

 private:
  bool counts(int x, int y, const GridMask& is_left_out) const;
  DepthImage counted(const GridMask& is_left_out) const;

  const DepthImage& image_;
  const DepthOptions& options_;
  ValueRange valid_;
  int reduction_;
};

// A row or a column of a grid. Its grid points have the numbers from 0 to size - 1; between the points i and
// i + 1 lies the step i.
struct GridLine {
  const DepthGrid& grid;
  std::size_t first, stride;
  int size;

  std::size_t at(int i) const { return first + static_cast<std::size_t>(i) * stride; }
  bool has_step(int i) const {
    return i >= 0 && i + 1 < size && grid.bounds.is_known[at(i)] && grid.bounds.is_known[at(i + 1)];
  }
  float step(int i) const { return has_step(i) ? grid.height[at(i + 1)] - grid.height[at(i)] : 0; }
  // Returns whether the step i continues the slope of the step `next`, which lies before or after it. The last
  // step of a round side is steeper than the one before, on a sphere by up to 2.4 times.
  bool continues(int i, int next) const;
  // Returns whether the points i and i + 1 are known and the step between them is no jump.
  bool is_smooth(int i) const;
};

GridLine row_of(const DepthGrid& grid, int row);
GridLine column_of(const DepthGrid& grid, int column);

// Calls f for all rows and all columns.
template <typename F>
void each_line(const DepthGrid& grid, F&& f) {
  for (int r = 0; r < grid.bounds.height; ++r) f(row_of(grid, r));
  for (int c = 0; c < grid.bounds.width; ++c) f(column_of(grid, c));
}

// Joins neighbouring grid points unless there is a depth jump between them, which terrain does not have.
void join(DepthGrid& grid);

// Returns a mask of the background: what lies behind a depth jump all around the figure and reaches most of
// the image's border. Without strong evidence it is empty, or if `is_wanted` the grid points behind the depth
// that best separates two groups of depths, of which the far one covers most of the border.
GridMask find_background(const DepthGrid& grid, bool is_wanted);

struct BlurLimits {
  int widest = 0;         // number of blurred points beside each other
  float least_share = 0;  // least distance between the two levels, as a share of all depths
};

// Makes unknown what is thinner than 3 grid points, such as the teeth of a depth camera's outlines: a known point
// stays if a square of 3 x 3 known points contains it, of which those beyond the grid count as known. Returns the
// number of points that became unknown.
std::size_t drop_teeth(BoundedGrid& grid);

// Adds to the mask the grid points between two levels which continue neither, as blurred outlines have, in
// rows and columns. Returns the number of points that were added.
std::size_t add_blur(const DepthGrid& grid, const BlurLimits& limits, GridMask& is_left_out);

}  // namespace relievo
