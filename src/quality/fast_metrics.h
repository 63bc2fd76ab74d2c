// What reliefs keep of a model, to find out how tightly they may be held: Judge's coarsest detail and its
// order, estimated in a millisecond or two on a picture of half the width, or as Judge finds them.
#pragma once

#include <span>

#include "quality/model_picture.h"
#include "quality/plane_measures.h"

namespace relievo {

// Calls f(pixel, the first of the four it is made of) for a picture of half the width, row by row.
template <typename F>
void each_half(const PictureGrid& grid, F&& f) {
  const int width = grid.width() / 2;
  for (int y = 0; y < grid.height() / 2; ++y)
    for (int x = 0; x < width; ++x)
      f(static_cast<std::size_t>(y * width + x), static_cast<std::size_t>(2 * (y * grid.width() + x)));
}

// Judge's detail at its coarsest scale, and its order.
struct Kept {
  double detail = 0, order = 0;
};

// Const calls may run concurrently. Without pixels to look at all measures are 0.
class QuickJudge {
 public:
  explicit QuickJudge(const Surface& surface);

  // Number of pixels that are looked at: where Judge looks at all four.
  std::size_t pixels() const { return where_.pixels.size(); }

  // Draws heights, one per point, in pixels.
  Plane draw(std::span<const double> heights) const;

  // The same, four times as fast, of heights without detail: height(i) is that of point i.
  template <typename F>
  Plane draw_smooth(F&& height) const;

  // Estimates what drawn heights keep: of curvature smoothed by 2 pixels, and of fewer pairs.
  Kept kept(const Plane& z) const;

  // What Judge finds for heights, one per point, in ten times the time.
  Kept kept_by_whole(std::span<const double> heights) const;

 private:
  Plane halved(const Plane& fine) const;

  ModelPicture picture_;  // as fine as Judge's
  Measured where_;
  MeasuredGaussian smoothing_, whole_smoothing_;
  Plane depth_, curvature_, whole_curvature_;  // of the model
};

// Two of the four, across. Heights are in pixels twice as wide.
template <typename F>
Plane QuickJudge::draw_smooth(F&& height) const {
  Plane half(where_.is_measured.size());
  const PictureGrid& grid = picture_.grid;
  const auto across = static_cast<std::size_t>(grid.width()) + 1;
  const auto scale = static_cast<float>(1 / (4 * grid.units_per_pixel()));
  each_half(grid, [&](std::size_t i, std::size_t first) {
    half[i] = scale * (grid.at(first, height, 0) + grid.at(first + across, height, 0));
  });
  return half;
}

}  // namespace relievo
