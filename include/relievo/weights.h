// Normal space compression (stages 8 and 9): how much of each normal the relief keeps. Paper, equations (5)
// to (7).
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "relievo/core/types.h"
#include "relievo/relief/layers.h"
#include "relievo/relief/tone_curve.h"

namespace relievo {

// Height and saturation of a relief. The paper's height coefficient is alpha; u = alpha^-beta says the same
// for every beta > 0 and gives every height at beta = 0 as well, where alpha has no effect.
struct Compression {
  double u = 1;     // [0, infinity]; 0 is flat, infinity keeps every normal that has curvature
  double beta = 0;  // saturation coefficient, [0, 100]; 0 compresses all points alike
  // In place of the exponential of (6): w_k = 1 - (1 - curve(|k|))^u, so that u still sets the height and 1
  // keeps what the curve says; beta has no effect then.
  std::shared_ptr<const ToneCurve> curve = nullptr;

  // Curves are alike if they go through the same points.
  bool operator==(const Compression& other) const;

  // From the paper's pair; alpha in [0, infinity).
  static Compression from_alpha(double alpha, double beta);
  // The paper's height coefficient u^(-1/beta); NaN where beta = 0 leaves it open.
  double alpha() const;
};

// All that shapes a relief.
struct Shape {
  Compression compression;    // height and saturation
  double gamma = 0;           // detail coefficient, [0, 1]; in layers it holds the coarse ones back
  double max_slope = 4;       // steepest slope asked of the surface, > 0; 4 is 76 degrees
  double boundary_width = 2;  // of (7), in rho, > 0: more softens the rim
  Style style = Style::paper;
  std::optional<Hold> hold = {};  // of layered heights; unless set, the model's: ReliefModel::hold_at()

  bool operator==(const Shape&) const = default;
};

// Equation (6), w_k = 1 - exp(-(|k| / (alpha delta))^beta) = 1 - exp(-u (|k| / delta)^beta), in [0, 1]. Never
// overflows. Where delta is 0 (no curvature anywhere) all points are alike, as for beta = 0.
double curvature_weight(double k, double delta, const Compression& compression);

// Equation (7), w_b = 1 - exp(-(distance / (2 rho))^2), in [0, 1].
double boundary_weight(double distance, double rho);

// The slope (dz/dx, dz/dy) of the compressed normal w n + (1 - w) (0, 0, 1), equation (5), shortened to at
// most `max_slope`. The normal is a unit vector with z >= 0.
Vec2 compressed_slope(const Vec3& normal, double w, double max_slope);

// What the slopes of points depend on, one entry per point.
struct SlopeInput {
  std::span<const Vec3f> normals;
  std::span<const float> k;
  std::span<const float> boundary_weight;
  double delta = 0;                          // of k
  std::span<const PointLayers> layers = {};  // for layered_slopes() alone
};

// Writes the compressed slope of every point, with w = w_k w_b.
void compressed_slopes(const SlopeInput& input, const Compression& compression, double max_slope,
                       std::span<Vec2> slopes);

// The same in layers: layered_slope() with layer_weights(shape), times w_b and the saturation's share.
void layered_slopes(const SlopeInput& input, const Shape& shape, std::span<Vec2> slopes);

// What our method starts from: even compression, coarse layers held back a little.
Shape layered_shape();

// Of a layered shape; without a hold nothing is levelled.
LayerWeights layer_weights(const Shape& shape);

// The compression whose weight, times saturation_scale(), is the share of a point's slope that saturation or
// tone curve leave in layers; for saturation 0 it is 1 everywhere.
Compression saturation_alone(const Compression& compression);
double saturation_scale(const Compression& compression);

// Returns w_b for distances to the boundary.
std::vector<float> boundary_weights(std::span<const float> distance, double rho);

}  // namespace relievo
