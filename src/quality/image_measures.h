// Measures on images how much of a model its relief preserves.
#pragma once

#include <array>
#include <vector>

#include "relievo/core/image.h"
#include "relievo/core/types.h"

namespace relievo {

// A Gaussian filter with the standard deviation `sigma`, cut off at `radius`, both in pixels. Outside the
// image the border's pixels are repeated.
class GaussianFilter {
 public:
  GaussianFilter(double sigma, int radius);
  void apply(Image<float>& image) const;

 private:
  std::vector<float> weights_;  // weights at the centre and at each distance from it
};

// Returns a mask that is 1 at a pixel if any pixel of the square of 2 `radius` + 1 pixels around it is not 0, else 0.
Image8 dilated(const Image8& mask, int radius);

// The pixels of an image on which the measures are computed, called measured pixels.
struct PixelMask {
  Image8 mask;                // never set in the first and last row and column
  std::vector<Index> pixels;  // indices of the mask's pixels

  PixelMask() = default;
  explicit PixelMask(Image8 image);
};

// Returns the divergence of the vectors (x, y) at measured pixels, even if neighbouring pixels are not measured; 0
// elsewhere. y points up, although rows are numbered downwards.
Image<float> divergence(const Image<float>& x, const Image<float>& y, const PixelMask& where);

// A Gaussian blur that uses only measured pixels (normalised convolution).
class MaskedGaussian {
 public:
  MaskedGaussian(double sigma, int radius, const PixelMask& where);
  // Blurs the image. Pixels that are not measured must be 0 before the call, and they are undefined after it.
  void apply(Image<float>& image, const PixelMask& where) const;

 private:
  GaussianFilter filter_;
  Image<float> weight_;  // per pixel: the share of the kernel on measured pixels
};

// Parameters of ReliefMetrics: the standard deviations of the blurs with which detail is compared, in pixels, and the
// number of random pairs for the order of depths.
inline constexpr std::array<int, 3> detail_scales_px{1, 2, 4};
inline constexpr std::size_t order_pairs = 200000;

// Returns the filter that blurs the curvature before detail is compared at this scale.
inline MaskedGaussian detail_gaussian(int scale_px, const PixelMask& where) {
  return {static_cast<double>(scale_px), 3 * scale_px, where};
}

// Returns the correlation coefficient of the values at measured pixels; 0 if the values of one image are all
// equal.
double correlation(const Image<float>& a, const Image<float>& b, const PixelMask& where);

// Compares random pairs of measured pixels whose depths differ by more than 1 % of the depth range; the pairs
// are always the same. Returns the share of pairs that have the same order in the heights z; 0 if there are
// no such pairs.
double order_kept(const Image<float>& z, const Image<float>& depth, const PixelMask& where);

// Does the same as order_kept() for pairs whose distance is between these shares of the picture's longer side. People
// compare depths along one slope, not across the whole picture (Koenderink, van Doorn 1995: Relief: pictorial and
// otherwise).
inline constexpr double nearest_near_pair = .03, farthest_near_pair = .1;
double near_order_kept(const Image<float>& z, const Image<float>& depth, const PixelMask& where);

}  // namespace relievo
