// What reliefs keep of a model, in a millisecond or two, to find out how tightly they may be held: Judge's
// coarsest detail and its order, on a picture of half the width.
#pragma once

#include <span>

#include "model_picture.h"
#include "plane_measures.h"

namespace relievo {

// Const calls may run concurrently. Without pixels to look at all measures are 0.
class QuickJudge {
 public:
  explicit QuickJudge(const Surface& surface);

  // Number of pixels that are looked at: where Judge looks at all four.
  std::size_t pixels() const { return where_.pixels.size(); }

  // Draws heights, one per point, in pixels.
  Plane draw(std::span<const double> heights) const;

  // The same, four times as fast, of heights without detail.
  Plane draw_smooth(std::span<const float> heights) const;

  // The correlation of the curvature of model and relief, smoothed by 2 pixels; z is drawn.
  double detail(const Plane& z) const;

  // The share of pairs of pixels whose order in depth the drawn heights keep.
  double order(const Plane& z) const;

 private:
  Plane halved(const Plane& fine) const;
  Plane smoothed_curvature(const NormalPicture& n) const;

  ModelPicture picture_;  // as fine as Judge's
  Measured where_;
  MeasuredGaussian smoothing_;
  Plane depth_, curvature_;  // of the model
};

}  // namespace relievo
