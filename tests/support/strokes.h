// Makes strokes, and applies them to surfaces, reliefs and frames.
#pragma once

#include "relief/stroke_fields.h"
#include "relievo/relief/frame.h"
#include "support/surfaces.h"

namespace relievo::test {

inline Stroke dab(Brush brush, const Vec3& at, double radius = .3, double amount = 1) {
  return {.brush = brush, .amount = amount, .radius = radius, .points = {at}};
}

// Returns the stroke's weight at each point of the surface.
inline std::vector<float> weights_of(const Surface& surface, const Stroke& stroke) {
  std::vector<float> weights(surface.points.size(), 0);
  const StrokeMask mask = stroke_mask(surface, stroke);
  for (std::size_t k = 0; k < mask.points.size(); ++k) weights[mask.points[k]] = mask.weights[k];
  return weights;
}

// Returns the heights z after the strokes are applied. `before` are the heights before the correction, if
// any.
template <typename Real = double>
std::vector<Real> applied(const Surface& surface, const Strokes& strokes, std::vector<Real> z,
                          double height = 1, const std::vector<Real>& before = {}) {
  StrokeFields<Real> fields(surface);
  fields.take(strokes);
  fields.apply(height, before, std::span<Real>(z));
  return z;
}

// Returns the layered shape with the given strokes.
inline Shape painted(const Strokes& strokes) {
  Shape shape = layered_shape();
  shape.strokes.list = std::make_shared<const Strokes>(strokes);
  return shape;
}

inline Frame frame_of(const ReliefModel& model, const FrameOptions& options) {
  Frame frame;
  FrameMaker(model).make(options, frame);
  return frame;
}

// Returns a square of side 2 whose left half is `depth` in front of its right half.
inline Surface step(double depth) {
  return surface_of(height_field(
      40000, 1, [=](double x, double) { return x < 0 ? depth : 0.; },
      [](double, double) { return Vec2(0, 0); }));
}

}  // namespace relievo::test
