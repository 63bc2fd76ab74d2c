// Represents a depth image as a grid of heights, before it becomes points. Each height has bounds within which it may
// be smoothed. Tested by tests/scan/depth_image_test.cpp.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "relievo/scan/depth_image.h"

namespace relievo {

struct ValueRange {
  double low = 0, high = 0;

  bool contains(float v) const { return std::isfinite(v) && double{v} >= low && double{v} <= high; }
  void extend(float v);
  static ValueRange none();  // empty; extend() makes it the range of one value
};

// Returns the range of the values that are depths. Values outside this range mark pixels without measurement
// or without object: 0 or less in depths, the largest value of the file's type, the value with which a
// renderer marks pixels without object, or the usual markers of terrain models. The last three kinds are
// recognised only if a wide gap separates them from all other values.
ValueRange valid_values(const DepthImage& image, DepthValues kind);

// Converts values into heights towards the viewer, in pixels of the image.
class HeightScale {
 public:
  // Without a camera, options.range is the height difference between the ends of `range`, as a multiple of the
  // image's longer side.
  HeightScale(const DepthImage& image, const DepthOptions& options, const ValueRange& range);

  // Returns the ratio of heights to values, like Cloud::units_per_value, but in pixels of the image.
  double units_per_value() const { return is_log_ ? 0 : scale_; }
  double height(double v) const { return scale_ * (is_log_ ? std::log(std::max(v, floor_)) : v); }

 private:
  bool is_log_ = false;
  double scale_ = 1, floor_ = 0;
};

// Estimates the uncertainty of values from the steps between the values that occur. The uncertainty is at least half
// the step of the file's number format.
class ValueSteps {
 public:
  explicit ValueSteps(const DepthImage& image);

  // Returns whether the values are from a depth camera: their steps are coarser than those of the file.
  bool are_sensors() const;
  double uncertainty(float v) const;

 private:
  double least_;
  std::vector<float> values_;  // values that occur at least three times, ascending
};

// A row-major grid. Bounds are valid only where `is_known` is set. Connections are valid only between two
// known points.
struct BoundedGrid {
  int width = 0, height = 0;
  std::vector<float> low, high;
  std::vector<std::uint8_t> is_known;
  // Per point: whether it is connected to its right or lower neighbour, so that no depth jump separates them.
  std::vector<std::uint8_t> joins_right, joins_down;

  std::size_t at(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column);
  }
};

// Returns the smoothest heights with low <= z <= high at all known points, and 0 at unknown points. Smoothest
// means: the sum over connected points of the squared second differences (along rows, along columns, and
// twice the mixed one) is nearly minimal. Solves from coarse to fine grids in linear time: 2 s for a million
// points on two cores.
std::vector<float> smoothest(const BoundedGrid& grid);

// Heights towards the viewer, in pixels of the reduced grid.
struct DepthGrid {
  BoundedGrid bounds;          // an interval around each height
  std::vector<float> height;   // heights of known grid points
  double units_per_value = 0;  // ratio of the heights to the image's values, see Cloud
  double noise = 0;
  // Whether the image is from a depth camera: its values have coarser steps than the file allows.
  bool is_sensor = false;
  // Whether the image shows terrain, which is a single surface: its steepest parts are slopes, not depth jumps.
  bool is_terrain = false;

  // Returns whether two known neighbours belong to one surface: the slope between them is below 76 degrees,
  // or their bounds explain the difference.
  bool is_near(std::size_t i, std::size_t j) const;
};

using GridMask = std::vector<std::uint8_t>;

// Makes grids of an image, reduced to about options.points points.
class GridMaker {
 public:
  GridMaker(const DepthImage& image, const DepthOptions& options);

  int reduction() const { return reduction_; }
  const ValueRange& valid() const { return valid_; }

  // Returns the grid; its points are not connected yet. The bounds account for noise and for the step between values.
  // `is_left_out` is a mask of grid points, or empty. The grid contains the points in the mask, but the range of
  // depths and the step are computed without them.
  DepthGrid make(const GridMask& is_left_out) const;

 private:
  bool counts(int x, int y, const GridMask& is_left_out) const;
  DepthImage counted(const GridMask& is_left_out) const;

  const DepthImage& image_;
  const DepthOptions& options_;
  ValueRange valid_;
  int reduction_;
};

// A row or a column of a grid. Its points are numbered from 0 to size - 1. Step i leads from point i to point i + 1.
struct GridLine {
  const DepthGrid& grid;
  std::size_t first, stride;
  int size;

  std::size_t at(int i) const { return first + static_cast<std::size_t>(i) * stride; }
  bool has_step(int i) const {
    return i >= 0 && i + 1 < size && grid.bounds.is_known[at(i)] && grid.bounds.is_known[at(i + 1)];
  }
  float step(int i) const { return has_step(i) ? grid.height[at(i + 1)] - grid.height[at(i)] : 0; }
  // Returns whether step i continues the slope of step `next`, which is the step before or after step i. At
  // the edge of a round shape, the last step is steeper than the step before it; on a sphere it is up to 2.4
  // times as steep.
  bool continues(int i, int next) const;
  // Returns whether the points i and i + 1 are known and belong to one surface.
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

// Connects neighbouring grid points unless there is a depth jump between them. Terrain has no depth jumps.
void join(DepthGrid& grid);

// Returns a mask of the background: the parts that lie behind depth jumps all around the figure and cover
// most of the image's border. Without strong evidence of a background, the mask is empty if `is_wanted` is
// false. If `is_wanted` is true, a threshold separates two groups of depths, and the mask contains the far
// group if this group covers most of the border.
GridMask find_background(const DepthGrid& grid, bool is_wanted);

struct BlurLimits {
  int widest = 0;         // largest number of adjacent blurred points
  float least_share = 0;  // least height difference of the two surfaces, as a share of the range of depths
};

// Marks structures thinner than 3 grid points as unknown, such as the thin teeth that depth cameras make
// along outlines. A point stays known if a square of 3 x 3 known points contains it; positions outside the
// grid count as known. Returns the number of points that became unknown.
std::size_t drop_teeth(BoundedGrid& grid);

// Finds blur along rows and columns. Blur is a run of points between two surfaces that continues neither
// surface. Adds the points of blur to the mask, and returns the number of added points.
std::size_t add_blur(const DepthGrid& grid, const BlurLimits& limits, GridMask& is_left_out);

}  // namespace relievo
