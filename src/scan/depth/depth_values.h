// The values of a depth image: which of them are depths, how uncertain they are, and the heights that they
// stand for. Tested by tests/scan/depth_image_test.cpp.
#pragma once

#include <cmath>
#include <vector>

#include "relievo/scan/depth_image.h"

namespace relievo {

struct ValueRange {
  double low = 0, high = 0;

  bool contains(float v) const { return std::isfinite(v) && double{v} >= low && double{v} <= high; }
  void extend(float v);
  static ValueRange none();  // extend() makes it the range of one value
};

// Returns the range of the values that are depths. Values outside mark pixels where nothing was measured or
// nothing is: 0 or less in depths, the largest value of the file's type, the far value of a renderer, or the
// usual numbers of terrain models. Such a value counts only if a wide gap separates it from all others.
ValueRange valid_values(const DepthImage& image, DepthValues kind);

// Converts values into heights, which grow towards the viewer, in pixels of the image.
class HeightScale {
 public:
  // Without a camera, depths and heights from one end of the range to the other are as deep as options.range
  // says, in widths of the picture.
  HeightScale(const DepthImage& image, const DepthOptions& options, const ValueRange& range);

  // See Cloud::units_per_value, in pixels of the image.
  double units_per_value() const { return is_log_ ? 0 : scale_; }
  double height(double v) const { return scale_ * (is_log_ ? std::log(std::max(v, floor_)) : v); }

 private:
  bool is_log_ = false;
  double scale_ = 1, floor_ = 0;
};

// Estimates the uncertainty of values that their steps cause: at least half a step of the file.
class ValueSteps {
 public:
  explicit ValueSteps(const DepthImage& image);

  // Returns whether the values come from a depth camera: their steps are then coarser than the file's.
  bool are_sensors() const;
  double uncertainty(float v) const;

 private:
  double least_;
  std::vector<float> values_;  // the values that occur at least three times, ascending
};

}  // namespace relievo
