// Defines the two styles, layered and paper weights. All differences between reliefs of the two
// styles are in this file.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "core/height_span.h"
#include "relief/correction/height_correction.h"
#include "relief/layered_slopes.h"
#include "relievo/core/parallel.h"
#include "relievo/relief/attention.h"
#include "relievo/relief/weights.h"
#include "relievo/scan/surface.h"

namespace relievo {

// Returns the inputs of the slope functions. The result refers to the arguments, which must outlive it.
inline SlopeInput slope_input(const Surface& surface, std::span<const PointLayers> layers,
                              std::span<const float> boundary_weight) {
  return {surface.normals, surface.curvature.k, boundary_weight, surface.curvature.delta, layers};
}

// Returns the rho to use in equation (7), so that the soft rim is `width` times the surface's rho wide. With
// the surface's own rho, (7) makes a rim that is 2 rho wide.
inline double boundary_rho(const Surface& surface, double width) {
  return surface.rho * width / 2;
}

// The heights of a relief while it is made.
template <typename Real>
struct RaisedHeights {
  std::span<Real> z;
  const SlopeInput& input;
  std::vector<HeightSpan<Real>>& spans;  // scratch memory, so that frames allocate nothing
  HeightSpan<Real> span = {};            // span of z, set by raise() and finish()
  double height = 0;                     // height of the relief, set by raise() and finish()

  // Calls change(i, z) for every height z; the call may change z. Returns the span of the results.
  template <typename Change>
  HeightSpan<Real> change_all(Change change) const {
    spans.resize((z.size() + default_grain - 1) / default_grain);
    parallel_ranges(z.size(), default_grain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) change(i, z[i]);
      spans[begin / default_grain] = span_of_run(std::span<const Real>(z).subspan(begin, end - begin));
    });
    HeightSpan<Real> all;
    for (const HeightSpan<Real>& part : spans) all.extend(part);
    return all;
  }

  HeightSpan<Real> measured() const {
    return change_all([](std::size_t, Real&) {});
  }
};

// The least divisor of gains. A smaller divisor would turn small changes of normals near the steepest slopes
// into very large changes of slopes.
inline constexpr float least_gain_divisor = .25F;

// A style is used in this order. slope() is called for every point, with the w_k of weighted(). Equation (9) is solved,
// which gives the heights. raise() determines the relief's height. If this is the requested height, finish() is called.

// Implements equations (5) to (7) of the paper on our surface, and the paper's second equation (9), which
// adds detail in proportion to the curvature.
class PaperWeightsStyle {
 public:
  explicit PaperWeightsStyle(const Shape& shape) : shape_(shape) {}

  // Returns the compression from which the weights w_k of slope() are computed.
  Compression weighted() const { return shape_.compression; }

  template <typename Real>
  Eigen::Vector2<Real> slope(const SlopeInput& input, std::size_t i, Real w_k, Real w_b) const {
    return compressed_slope(input.normals[i].template cast<Real>(), w_k * w_b,
                            static_cast<Real>(shape_.max_slope));
  }

  // Returns the derivative of the slope with respect to -(n_x, n_y).
  float gain(const SlopeInput& input, std::size_t i, float w_k, float w_b) const {
    const float w = w_k * w_b;
    return w / std::max(w * input.normals[i].z() + 1 - w, least_gain_divisor);
  }

  // Adds detail in proportion to the curvature.
  template <typename Real>
  void raise(RaisedHeights<Real>& heights) const {
    const Real amount = static_cast<Real>(shape_.gamma) * heights.measured().size();
    const SlopeInput& input = heights.input;
    heights.span = heights.change_all([&](std::size_t i, Real& z) {
      z += amount * static_cast<Real>(input.k[i]) * static_cast<Real>(input.boundary_weight[i]);
    });
    heights.height = static_cast<double>(heights.span.size());
  }

  // Returns the relief's height divided by the span of its heights before finish().
  double height_share() const { return 1; }

  template <typename Real, typename Workspace>
  void finish(RaisedHeights<Real>&, const HeightCorrection&, Workspace&&) const {}

 private:
  const Shape& shape_;
};

// The layered style uses layers of the normals instead of equation (5). Afterwards HeightCorrection
// compresses the heights.
class LayeredStyle {
 public:
  explicit LayeredStyle(const Shape& shape)
      : shape_(shape), weights_(relievo::layer_weights(shape)), scale_(saturation_scale(shape.compression)) {
    if (shape.attention == 0) return;
    for (int level = 0; level < attention_levels; ++level)
      by_attention_[static_cast<std::size_t>(level)] = relievo::layer_weights(shape, attention_at(level));
  }

  Compression weighted() const { return saturation_alone(shape_.compression); }

  const LayerWeights& layer_weights(const SlopeInput& input, std::size_t i) const {
    return input.attention.empty() ? weights_ : by_attention_[input.attention[i]];
  }

  // These two functions return what write_slopes_by_eight() needs to compute the same as slope().
  double scale() const { return scale_; }
  double max_slope() const { return shape_.max_slope; }

  template <typename Real>
  Eigen::Vector2<Real> slope(const SlopeInput& input, std::size_t i, Real w_k, Real w_b) const {
    const Real saturation = static_cast<Real>(scale_) * w_k;
    return layered_slope(input.layers[i], layer_weights(input, i), saturation * w_b,
                         static_cast<Real>(shape_.max_slope));
  }

  // Returns the derivative of the slope with respect to the fine layer.
  float gain(const SlopeInput& input, std::size_t i, float w_k, float w_b) const {
    const LayerWeights& weights = layer_weights(input, i);
    const float weight = static_cast<float>(scale_) * w_k * w_b, t = weights.height_share;
    const float sine_sq = weight * weight * weighted_sum(input.layers[i], weights).squaredNorm();
    return weight * weights.fine / std::sqrt(std::max(1 - t * t * sine_sq, least_gain_divisor));
  }

  double height_share() const { return relievo::height_share(shape_); }

  template <typename Real>
  void raise(RaisedHeights<Real>& heights) const {
    heights.span = heights.measured();
    heights.height = height_share() * static_cast<double>(heights.span.size());
  }

  // Compresses the heights to the relief's height. workspace() returns the scratch memory.
  template <typename Real, typename Workspace>
  void finish(RaisedHeights<Real>& heights, const HeightCorrection& correction, Workspace&& workspace) const {
    if (!shape_.is_corrected) return;
    const HeightLimits limits = HeightLimits::of(heights.height, shape_);
    correction.compress_heights<Real>({heights.z, heights.input.boundary_weight, limits}, workspace());
    heights.span = heights.measured();
    heights.height = static_cast<double>(heights.span.size());
  }

 private:
  const Shape& shape_;
  LayerWeights weights_;
  std::array<LayerWeights, attention_levels> by_attention_;  // used only if the shape has attention
  double scale_;
};

// Returns f(style), where `style` implements the style of the shape. The shape must outlive the call.
template <typename F>
decltype(auto) with_style(const Shape& shape, F&& f) {
  return shape.style == Style::layered ? f(LayeredStyle(shape)) : f(PaperWeightsStyle(shape));
}

// Writes the target slope of every point, with w_k = weight(k).
template <typename Real, typename Style, typename Weight>
void write_slopes(const SlopeInput& input, const Style& style, const Weight& weight,
                  std::span<Eigen::Vector2<Real>> slopes) {
  parallel_for(slopes.size(), [&](std::size_t i) {
    slopes[i] = style.template slope<Real>(input, i, static_cast<Real>(weight(input.k[i])),
                                           static_cast<Real>(input.boundary_weight[i]));
  });
}

class WeightTable;

// Writes the slopes of the layered style in single precision, eight points at a time. The results have the
// same bits as those of write_slopes().
void write_slopes_by_eight(const SlopeInput& input, const LayeredStyle& style, const WeightTable& weight,
                           std::span<Vec2f> slopes);

}  // namespace relievo
