// A height map as a smooth base. Tested by base_test.
#pragma once

#include "relievo/plate/base.h"

namespace relievo {

// The cubic B-spline whose control points are the map's values: it is smooth and stays between the
// neighbouring values, so that it evens out steps from rounding. Beyond the border the outermost values are
// repeated.
class Base::ImageSurface {
 public:
  // Centres the map on a plate of that size, scales it until it covers the plate, and makes it `height_mm`
  // high from the lowest to the highest value.
  ImageSurface(std::shared_ptr<const Image<float>> grid, const Vec2& plate_mm, double height_mm);

  double pixel_mm() const { return pixel_mm_; }
  double height(const Vec2& from_middle) const;

 private:
  // Returns the spline at a place, in the map's unit.
  double value(const Vec2& from_middle) const;

  std::shared_ptr<const Image<float>> grid_;
  double pixel_mm_ = 1, mm_per_value_ = 0;
  double middle_ = 0;  // the value in the plate's middle
};

}  // namespace relievo
