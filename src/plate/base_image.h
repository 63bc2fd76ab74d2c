// A height map as a smooth base.
#pragma once

#include "relievo/plate/base.h"

namespace relievo {

// The cubic B-spline over the map's values: it bends smoothly, keeps between the values around it and takes
// steps of rounding away. Beyond the border the outermost values go on.
class Base::Image {
 public:
  // Centred, as large as covers a plate of that size, from its lowest to its highest value `height_mm` high.
  Image(std::shared_ptr<const HeightGrid> grid, const Vec2& plate_mm, double height_mm);

  double pixel_mm() const { return pixel_mm_; }
  double height(const Vec2& from_middle) const;
  Vec2 slope(const Vec2& from_middle) const;

 private:
  // The sum of the values around a place, each times the product of its weights in x and in y.
  template <typename X, typename Y>
  double sum(const Vec2& from_middle, const X& weights_x, const Y& weights_y) const;

  std::shared_ptr<const HeightGrid> grid_;
  double pixel_mm_ = 1, mm_per_value_ = 0;
  double middle_ = 0;  // value in the plate's middle
};

}  // namespace relievo
