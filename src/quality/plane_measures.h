// What a relief keeps of its model, measured on pictures.
#pragma once

#include <array>
#include <vector>

#include "quality/picture.h"

namespace relievo {

// Where planes are looked at.
struct Measured {
  int width = 0;
  std::vector<std::uint8_t> is_measured;  // per pixel; none in the first and last row and column
  std::vector<Index> pixels;              // those that are

  Measured() = default;
  Measured(int width, std::vector<std::uint8_t> is_measured);
};

// div (x, y) at measured pixels, where all neighbours count, 0 elsewhere. y points up, rows run down.
Plane divergence(const Plane& x, const Plane& y, const Measured& where);

// A Gaussian's average over measured pixels alone.
class MeasuredGaussian {
 public:
  MeasuredGaussian(double sigma, int reach, const Measured& where);
  // Values at other pixels have to be 0, and come out as anything.
  void apply(Plane& plane, const Measured& where) const;

 private:
  GaussianFilter filter_;
  Plane weight_;  // what of it lies on measured pixels
};

// Judge's: what detail is smoothed by, in pixels, and how many pairs tell the order.
inline constexpr std::array<int, 3> detail_scales_px{1, 2, 4};
inline constexpr std::size_t order_pairs = 200000;

// What curvature is smoothed by, to tell the detail of a scale.
inline MeasuredGaussian detail_gaussian(int scale_px, const Measured& where) {
  return {static_cast<double>(scale_px), 3 * scale_px, where};
}

// Of values at measured pixels; 0 if all of a plane's are equal.
double correlation(const Plane& a, const Plane& b, const Measured& where);

// Returns the share of random pairs of measured pixels, the same ones every time and further apart in depth
// than 1 % of the depth range, whose order the heights z keep; 0 if there are none.
double order_kept(const Plane& z, const Plane& depth, const Measured& where, std::size_t pairs);

}  // namespace relievo
