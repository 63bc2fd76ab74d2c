#include "relief/stroke_fields.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/height_span.h"
#include "core/lists.h"
#include "relievo/core/parallel.h"
#include "relievo/relief/weights.h"

namespace relievo {
namespace {

double faded(double distance, const Stroke& stroke) {
  const double x = std::max(0.0, (distance / stroke.radius - 1) / stroke.softness + 1);
  return (1 - x * x) * (1 - x * x);
}

bool is_wide(Brush brush) {
  return brush == Brush::strengthen;
}

bool is_blur(Brush brush) {
  return is_wide(brush) || brush == Brush::sharpen || brush == Brush::soften;
}

// Returns the amount of a stroke, negative if its brush subtracts.
double signed_amount(const Stroke& stroke) {
  return stroke.brush == Brush::soften || stroke.brush == Brush::sink ? -stroke.amount : stroke.amount;
}

template <typename Real>
void level(const StrokeMask& mask, double amount, std::span<Real> z) {
  double sum = 0, weight = 0;
  for (std::size_t k = 0; k < mask.points.size(); ++k) {
    sum += static_cast<double>(mask.weights[k]) * static_cast<double>(z[mask.points[k]]);
    weight += static_cast<double>(mask.weights[k]);
  }
  const Real mean = static_cast<Real>(sum / weight);
  for (std::size_t k = 0; k < mask.points.size(); ++k) {
    Real& height = z[mask.points[k]];
    height += static_cast<Real>(amount) * static_cast<Real>(mask.weights[k]) * (mean - height);
  }
}

}  // namespace

StrokeMask stroke_mask(const Surface& surface, const Stroke& stroke) {
  const StrokePoints near = points_of(surface, stroke);
  StrokeMask mask;
  for (Index i = 0; i < near.points.size(); ++i) {
    const auto distance = static_cast<double>(surface.boundary.distance[near.points[i]]);
    const double weight = faded(near.distances[i], stroke) * boundary_weight(distance, surface.rho);
    if (!(weight > 0)) continue;
    mask.points.push_back(near.points[i]);
    mask.weights.push_back(static_cast<float>(weight));
  }
  return mask;
}

template <typename Real>
typename StrokeFields<Real>::Layer StrokeFields<Real>::layer_of(const Stroke& stroke) {
  Layer layer{stroke, stroke.is_muted ? StrokeMask() : stroke_mask(*surface_, stroke), {}, {}, {}};
  if (stroke.brush == Brush::in_front) layer.crossings = crossings_of(*surface_, layer.mask);
  if (!is_blur(stroke.brush) || layer.mask.points.empty()) return layer;
  if (!links_) links_ = surface_links(*surface_);
  const double sigma = (is_wide(stroke.brush) ? wide_blur : narrow_blur) * surface_->longer_side();
  layer.blur.emplace(*surface_, *links_, layer.mask.points, sigma);
  return layer;
}

template <typename Real>
void StrokeFields<Real>::take_layers(const Strokes& strokes) {
  std::vector<std::optional<Layer>> old;
  for (Layer& layer : layers_) old.emplace_back(std::move(layer));
  layers_.clear();
  std::size_t next = 0;  // index in `old` that is tried first, because most strokes keep their order
  for (const Stroke& stroke : strokes) {
    const auto is_same = [&](const std::optional<Layer>& layer) { return layer && layer->stroke == stroke; };
    const auto found = next < old.size() && is_same(old[next])
                           ? old.begin() + static_cast<std::ptrdiff_t>(next)
                           : std::ranges::find_if(old, is_same);
    if (found == old.end()) {
      layers_.push_back(layer_of(stroke));
      continue;
    }
    layers_.push_back(*std::move(*found));
    found->reset();
    next = static_cast<std::size_t>(found - old.begin()) + 1;
  }
}

template <typename Real>
void StrokeFields<Real>::take(const Strokes& strokes) {
  if (std::ranges::equal(strokes, layers_, {}, {}, &Layer::stroke)) return;
  take_layers(strokes);
  std::vector<std::uint8_t> is_changed(surface_->points.size(), 0);
  for (const Layer& layer : layers_)
    for (const Index i : layer.mask.points) is_changed[i] = 1;
  changed_ = indices_where(is_changed.size(), [&](Index i) { return is_changed[i] != 0; });
  sum_masks();
}

// Computes StrokeBlur::removed() from the heights z. Skips layers for which it was computed from z before.
template <typename Real>
void StrokeFields<Real>::take_blurs(std::span<const Real> z) {
  const bool is_same = std::ranges::equal(z, blurred_);
  if (!is_same) blurred_.assign(z.begin(), z.end());
  std::vector<StrokeBlur<Real>*> blurs;
  for (Layer& layer : layers_)
    if (layer.blur && !(is_same && !layer.blur->removed().empty())) blurs.push_back(&*layer.blur);
  if (blurs.size() == 1) return blurs[0]->take(z);  // a single blur may use all threads
  parallel_for(
      blurs.size(), [&](std::size_t i) { blurs[i]->take(z); }, 1);
}

// Computes the sums that depend on the strokes alone. They are limited, because several strokes together
// must not subtract more than a blur removes.
template <typename Real>
void StrokeFields<Real>::sum_masks() {
  const std::vector<Index> number = places_in(changed_, surface_->points.size());
  std::array<std::vector<Real>, 2> amounts;  // first for the narrow blurs, then for the wide ones
  for (std::vector<Real>* sums : {&amounts[0], &amounts[1], &risen_}) sums->assign(changed_.size(), 0);
  const auto each_share = [&](Layer& layer, auto&& f) {
    const auto amount = static_cast<Real>(signed_amount(layer.stroke));
    for (std::size_t k = 0; k < layer.mask.points.size(); ++k)
      f(number[layer.mask.points[k]], amount * static_cast<Real>(layer.mask.weights[k]));
  };
  for (Layer& layer : layers_) {
    const Brush brush = layer.stroke.brush;
    if (!layer.blur && brush != Brush::raise && brush != Brush::sink) continue;
    std::vector<Real>& sums = layer.blur ? amounts[is_wide(brush)] : risen_;
    each_share(layer, [&](Index at, Real share) { sums[at] += share; });
  }
  for (Layer& layer : layers_) {
    layer.shares.clear();
    if (!layer.blur) continue;
    const std::vector<Real>& sums = amounts[is_wide(layer.stroke.brush)];
    each_share(layer, [&](Index at, Real share) {
      layer.shares.push_back({at, share / std::max(Real(1), -sums[at])});
    });
  }
}

// Calls f(layer) for each layer that has this brush and at least one point.
template <typename Real>
template <typename F>
void StrokeFields<Real>::each_of(Brush brush, F&& f) const {
  for (const Layer& layer : layers_)
    if (layer.stroke.brush == brush && !layer.mask.points.empty()) f(layer);
}

// Adds the changes of Brush::raise, Brush::sink and the brushes that blur. These changes do not depend on
// the order of the strokes.
template <typename Real>
void StrokeFields<Real>::add_sums(double height, std::span<Real> z) {
  take_blurs(z);
  added_.resize(changed_.size());
  for (std::size_t k = 0; k < added_.size(); ++k) added_[k] = static_cast<Real>(height) * risen_[k];
  for (const Layer& layer : layers_)
    for (std::size_t k = 0; k < layer.shares.size(); ++k)
      added_[layer.shares[k].at] += layer.shares[k].share * layer.blur->removed()[k];
  for (std::size_t k = 0; k < added_.size(); ++k) z[changed_[k]] += added_[k];
}

template <typename Real>
void StrokeFields<Real>::apply(double height, std::span<const Real> uncorrected, std::span<Real> z) {
  if (empty()) return;
  if (!uncorrected.empty())
    each_of(Brush::protect, [&](const Layer& layer) {
      protect<Real>({*surface_, height, uncorrected, z}, layer.mask, layer.stroke.amount);
    });
  add_sums(height, z);
  each_of(Brush::level, [&](const Layer& layer) { level(layer.mask, layer.stroke.amount, z); });
  each_of(Brush::in_front, [&](const Layer& layer) {
    bring_forward<Real>(
        {layer.crossings, static_cast<Real>(height * layer.stroke.amount), static_cast<Real>(height)},
        layer.mask, z);
  });
  for (const Index i : changed_) z[i] = std::max(z[i], Real(0));
}

template class StrokeFields<float>;
template class StrokeFields<double>;

bool needs_uncorrected(const SharedStrokes& strokes) {
  return strokes.list && std::ranges::any_of(*strokes.list, [](const Stroke& stroke) {
           return stroke.brush == Brush::protect && !stroke.is_muted;
         });
}

void apply_strokes(const Surface& surface, std::span<const double> uncorrected, Relief& relief) {
  if (!relief.shape.strokes.list) return;
  StrokeFields<double> fields(surface);
  fields.take(*relief.shape.strokes.list);
  fields.apply(relief.height, uncorrected, relief.heights);
  const double height = height_span(relief.heights);
  if (!(height > 0)) return;
  for (double& z : relief.heights) z *= relief.height / height;
}

}  // namespace relievo
