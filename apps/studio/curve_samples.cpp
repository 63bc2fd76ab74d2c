#include "studio/curve_samples.h"

#include <algorithm>

namespace relievo::app::studio {

CurveSamples sample_curve(const Shape& shape, double delta) {
  const bool is_layered = shape.style == Style::layered;
  const Compression saturation = saturation_alone(shape.compression);
  // Layers keep a slope as it is where the share is 1, whatever the formula's largest value.
  const double scale = is_layered ? saturation_scale(shape.compression) : 1;
  CurveSamples samples;
  for (std::size_t i = 0; i < CurveSamples::size; ++i) {
    const double root = static_cast<double>(i) / (CurveSamples::size - 1), k = root * root;
    samples.share.push_back(std::min(1.0, scale * curvature_weight(k, delta, saturation)));
    samples.kept.push_back(is_layered ? samples.share.back() : curvature_weight(k, delta, shape.compression));
  }
  return samples;
}

}  // namespace relievo::app::studio
