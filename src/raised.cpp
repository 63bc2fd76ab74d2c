#include "raised.h"

#include <algorithm>
#include <array>

#include "extent.h"
#include "free_rim.h"
#include "relievo/parallel.h"
#include "surface_blur.h"

namespace relievo {
namespace {

// Of the longer side: how far from the silhouette the layers are whole, how far the pull towards a level
// reaches, and what the coarse form is averaged over.
constexpr double fade_width = .008, reach = .2, form_width = .023;
// How the coarse form is held back.
constexpr TailOptions form_tails{.share = .1, .flattest = .2, .keeps_base = false};
// The relief whose form that is.
constexpr double typical_u = .6, typical_detail = .04;

using Fields = std::array<std::vector<double>, 4>;  // heights: fine, middle, coarse, depth

std::vector<float> fades(const Surface& surface, double side) {
  std::vector<float> fade(surface.points.size());
  parallel_for(fade.size(), [&](std::size_t i) {
    const double t = std::min(static_cast<double>(surface.boundary.distance[i]) / (fade_width * side), 1.0);
    fade[i] = static_cast<float>(t * t * (3 - 2 * t));
  });
  return fade;
}

Fields solve_layers(const Surface& surface, const FreeRimSystem& system, std::span<const float> fade) {
  constexpr std::array<Vec2f PointLayers::*, 3> layers{&PointLayers::fine, &PointLayers::middle,
                                                       &PointLayers::coarse};
  Fields fields;
  std::vector<Vec2f> slopes(surface.points.size());
  for (std::size_t layer = 0; layer < layers.size(); ++layer) {
    parallel_for(slopes.size(),
                 [&](std::size_t i) { slopes[i] = fade[i] * surface.layers[i].*layers[layer]; });
    fields[layer] = system.solve(slopes, {});
  }
  std::vector<double> levels = depth_ranks(surface.points);
  const double side = longer_side_of(surface.points);
  for (double& level : levels) level *= side;
  fields[3] = system.solve({}, levels);
  return fields;
}

// The points that are not on the boundary, in the view plane.
struct FreePoints {
  std::vector<Index> which;
  std::vector<Vec3> places;

  explicit FreePoints(const Surface& surface) {
    for (Index i = 0; i < surface.points.size(); ++i) {
      if (surface.boundary.is_boundary[i]) continue;
      which.push_back(i);
      places.emplace_back(surface.points[i].x(), surface.points[i].y(), 0);
    }
  }
};

// A field averaged around each free point, less its mean.
std::vector<double> coarse_form(const std::vector<double>& field, const FreePoints& points,
                                const SurfaceBlur& blur) {
  std::vector<Vec2f> values(points.which.size());
  for (std::size_t f = 0; f < values.size(); ++f) values[f] = {static_cast<float>(field[points.which[f]]), 0};
  blur.apply(values);
  double sum = 0;
  for (const Vec2f& v : values) sum += static_cast<double>(v.x());
  const double mean = sum / static_cast<double>(values.size());
  std::vector<double> form(values.size());
  for (std::size_t f = 0; f < form.size(); ++f) form[f] = static_cast<double>(values[f].x()) - mean;
  return form;
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

// Bends the ends of the typical relief's coarse form. What that changes is shared out over the fields as the
// form is: each gets the part of it that its own form has.
void hold_form_back(Fields& fields, const FreePoints& points, double side) {
  const LayerWeights typical = LayerWeights::of(typical_u, typical_detail, Style::raised);
  const std::array weights{typical.fine, typical.middle, typical.coarse, typical.depth};
  const SurfaceBlur blur(points.places, form_width * side);
  Fields forms;
  std::vector<double> whole(points.which.size(), 0.0);
  for (std::size_t layer = 0; layer < fields.size(); ++layer) {
    forms[layer] = coarse_form(fields[layer], points, blur);
    for (std::size_t f = 0; f < whole.size(); ++f)
      whole[f] += static_cast<double>(weights[layer]) * forms[layer][f];
  }
  const double square = dot(whole, whole);
  if (!(square > 0)) return;
  const HeightTails<double> tails(whole, form_tails);
  for (std::size_t layer = 0; layer < fields.size(); ++layer) {
    const double part = dot(whole, forms[layer]) / square;
    for (std::size_t f = 0; f < whole.size(); ++f)
      fields[layer][points.which[f]] += part * (tails(whole[f]) - whole[f]);
  }
}

}  // namespace

RaisedLayers raised_layers(const Surface& surface) {
  RaisedLayers layers{std::vector<LayerHeights>(surface.points.size()),
                      std::vector<float>(surface.points.size(), 0.F)};
  const double side = longer_side_of(surface.points);
  const FreePoints points(surface);
  if (points.which.empty() || !(side > 0)) return layers;
  const Result<FreeRimSystem> system = FreeRimSystem::build(surface, reach * side);
  if (!system) return layers;
  layers.fade = fades(surface, side);
  Fields fields = solve_layers(surface, *system, layers.fade);
  hold_form_back(fields, points, side);
  parallel_for(layers.heights.size(), [&](std::size_t i) {
    const auto at = [&](std::size_t layer) { return static_cast<float>(fields[layer][i]); };
    layers.heights[i] = {at(0), at(1), at(2), at(3)};
  });
  return layers;
}

RaisedWeights RaisedWeights::of(const Shape& shape, double mean) {
  RaisedWeights weights;
  weights.kept = LayerWeights::of(shape.compression.u, shape.gamma, Style::raised);
  const auto m = static_cast<float>(mean);
  weights.linear = {m * weights.kept.fine, m * weights.kept.middle, m * weights.kept.coarse,
                    m * weights.kept.depth};
  weights.kept.depth = 0;  // ranks are heights of their own, they have no slopes
  return weights;
}

}  // namespace relievo
