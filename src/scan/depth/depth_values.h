// Finds which values of a depth image are depths, how uncertain they are, and which heights they represent. Tested by
// tests/scan/depth_image_test.cpp.
#pragma once

#include <cmath>
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

}  // namespace relievo
