// Fast estimates (2 to 3 ms, half resolution) of two of the measures of ReliefMetrics, coarse detail and
// depth order, and their exact versions. The height correction is tuned with them.
#pragma once

#include <span>

#include "quality/image_measures.h"
#include "quality/model_picture.h"

namespace relievo {

// Calls f(pixel, first) for every pixel of a picture of half the width, row by row; `first` is the upper left
// of the four full-size pixels that the pixel covers.
template <typename F>
void each_half(const BarycentricMap& grid, F&& f) {
  const int width = grid.width() / 2;
  for (int y = 0; y < grid.height() / 2; ++y)
    for (int x = 0; x < width; ++x)
      f(static_cast<std::size_t>(y * width + x), static_cast<std::size_t>(2 * (y * grid.width() + x)));
}

// Detail at the coarsest scale of ReliefMetrics, and depth order.
struct Scores {
  double detail = 0, order = 0;
};

// Const calls may run concurrently. All scores are 0 if there are no pixels to measure.
class FastMetrics {
 public:
  explicit FastMetrics(const Surface& surface);

  // Returns the number of measured pixels. A pixel is measured if ReliefMetrics measures all four pixels that
  // it covers.
  std::size_t pixels() const { return where_.pixels.size(); }

  // Returns the picture of heights, given one per point. Heights in the picture are in pixels.
  Image<float> draw(std::span<const double> heights) const;

  // Does the same in a quarter of the time for heights without fine detail: height(i) is that of point i.
  template <typename F>
  Image<float> draw_smooth(F&& height) const;

  // Estimates the scores of drawn heights, from curvature smoothed by 2 pixels and from fewer pairs.
  Scores estimate(const Image<float>& z) const;

  // Returns the scores that ReliefMetrics gives to heights, one per point. Takes ten times as long.
  Scores exact_scores(std::span<const double> heights) const;

 private:
  Image<float> halved(const Image<float>& fine) const;

  ModelPicture picture_;  // at the full resolution of ReliefMetrics
  PixelMask where_;
  MaskedGaussian smoothing_, exact_smoothing_;
  Image<float> depth_, curvature_, exact_curvature_;  // images of the model
};

// Samples two of the four pixels, on a diagonal. Pixels of half the resolution are twice as wide, so heights
// in pixels are half as large.
template <typename F>
Image<float> FastMetrics::draw_smooth(F&& height) const {
  Image<float> half = filled_image(where_.mask.width, where_.mask.height, 0.F);
  const BarycentricMap& grid = picture_.grid;
  const auto across = static_cast<std::size_t>(grid.width()) + 1;
  const auto scale = static_cast<float>(1 / (4 * grid.units_per_pixel()));
  each_half(grid, [&](std::size_t i, std::size_t first) {
    half[i] = scale * (grid.at(first, height, 0) + grid.at(first + across, height, 0));
  });
  return half;
}

}  // namespace relievo
