// Filters on images with one channel.
#pragma once

#include <vector>

#include "relievo/core/image.h"

namespace relievo {

// A Gaussian with the standard deviation `sigma`, cut at `radius`, both in pixels. The border continues
// outside.
class GaussianFilter {
 public:
  GaussianFilter(double sigma, int radius);
  void apply(Image<float>& image) const;

 private:
  std::vector<float> weights_;  // of the centre and of each distance from it
};

// Returns 1 where some pixel of the square of 2 `radius` + 1 pixels around is not 0, else 0.
Image8 dilated(const Image8& mask, int radius);

}  // namespace relievo
