// Measures of how much of its model a relief keeps, on pictures.
#pragma once

#include <array>
#include <vector>

#include "quality/picture.h"

namespace relievo {

// The pixels that are measured.
struct Measured {
  int width = 0;
  std::vector<std::uint8_t> is_measured;  // per pixel; never in the first and last row and column
  std::vector<Index> pixels;              // indices of the measured ones

  Measured() = default;
  Measured(int width, std::vector<std::uint8_t> is_measured);
};

// Returns div (x, y) at measured pixels, whatever their neighbours are, 0 elsewhere. y points up, rows run down.
Plane divergence(const Plane& x, const Plane& y, const Measured& where);

// Gaussian blur over measured pixels alone (normalised convolution).
class MeasuredGaussian {
 public:
  MeasuredGaussian(double sigma, int radius, const Measured& where);
  // Values at other pixels must be 0 before, and are undefined afterwards.
  void apply(Plane& plane, const Measured& where) const;

 private:
  GaussianFilter filter_;
  Plane weight_;  // the part of the kernel that lies on measured pixels
};

// Parameters of ReliefMetrics: the standard deviations of the detail, in pixels, and the number of random pairs of
// the order.
inline constexpr std::array<int, 3> detail_scales_px{1, 2, 4};
inline constexpr std::size_t order_pairs = 200000;

// Returns the blur of the curvature for the detail at a scale.
inline MeasuredGaussian detail_gaussian(int scale_px, const Measured& where) {
  return {static_cast<double>(scale_px), 3 * scale_px, where};
}

// Returns the correlation of values at measured pixels; 0 if all values of a plane are equal.
double correlation(const Plane& a, const Plane& b, const Measured& where);

// Returns the share of random pairs of measured pixels, the same ones every time and further apart in depth
// than 1 % of the depth range, whose order the heights z keep; 0 if there are none.
double order_kept(const Plane& z, const Plane& depth, const Measured& where, std::size_t pairs);

}  // namespace relievo
