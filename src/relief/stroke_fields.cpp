#include "relief/stroke_fields.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/disjoint_sets.h"
#include "core/height_span.h"
#include "relievo/core/parallel.h"
#include "relievo/relief/weights.h"
#include "scan/jumps.h"

namespace relievo {
namespace {

double distance_to_segment_sq(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a;
  const double length_sq = along.squaredNorm();
  const double t = length_sq > 0 ? std::clamp((p - a).dot(along) / length_sq, 0.0, 1.0) : 0;
  return (p - a - t * along).squaredNorm();
}

// A line in pieces of a few corners, so that most points need the distances from few of them.
class Line {
 public:
  explicit Line(std::span<const Vec3> corners) : corners_(corners) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (i % piece == 0) boxes_.emplace_back();
      // The segment before a corner belongs to the corner's piece.
      for (const Vec3& end : {corners[i], corners[i == 0 ? 0 : i - 1]}) boxes_.back().extend(end);
    }
  }

  // Returns the square of a point's distance from the line; `most_sq` if that is no less.
  double distance_sq(const Vec3& p, double most_sq) const {
    double least = most_sq;
    for (std::size_t k = 0; k < boxes_.size(); ++k) {
      const Vec3 outside = (boxes_[k].min - p).cwiseMax(p - boxes_[k].max).cwiseMax(0);
      if (outside.squaredNorm() >= least) continue;
      const std::size_t end = std::min(corners_.size(), (k + 1) * piece);
      for (std::size_t i = k * piece; i < end; ++i)
        least = std::min(least, distance_to_segment_sq(p, corners_[i == 0 ? 0 : i - 1], corners_[i]));
    }
    return least;
  }

 private:
  static constexpr std::size_t piece = 8;

  std::span<const Vec3> corners_;
  std::vector<Box> boxes_;  // one per piece
};

// The points within the radius of a line, and their distances from it.
struct Near {
  std::vector<Index> points;
  std::vector<double> distances;
};

Near points_near(const Surface& surface, std::span<const Vec3> line, double radius) {
  Box box;
  for (const Vec3& p : line) box.extend(p);
  const Vec3 least = box.min.array() - radius, most = box.max.array() + radius;
  std::vector<Index> in_box;
  for (Index i = 0; i < surface.points.size(); ++i) {
    const Vec3& p = surface.points[i];
    if ((p.array() < least.array()).any() || (p.array() > most.array()).any()) continue;
    if (!surface.boundary.is_boundary[i]) in_box.push_back(i);
  }
  const Line pieces(line);
  std::vector<double> distances(in_box.size());
  const auto measure = [&](std::size_t k) {
    distances[k] = std::sqrt(pieces.distance_sq(surface.points[in_box[k]], radius * radius));
  };
  parallel_for(in_box.size(), measure, 256);
  Near near;
  for (std::size_t k = 0; k < in_box.size(); ++k) {
    if (distances[k] >= radius) continue;
    near.points.push_back(in_box[k]);
    near.distances.push_back(distances[k]);
  }
  return near;
}

// Returns connected components of the given points. Edges inside the relief connect them, except across a
// depth jump.
DisjointSets connected(const Surface& surface, std::span<const Index> points) {
  std::vector<Index> number(surface.points.size(), no_index);
  for (Index i = 0; i < points.size(); ++i) number[points[i]] = i;
  DisjointSets sets(points.size());
  for (std::size_t t = 0; t < surface.triangulation.triangles.size(); ++t) {
    if (!surface.boundary.is_inside[t]) continue;
    const Triangle& corners = surface.triangulation.triangles[t];
    for (std::size_t side = 0; side < 3; ++side) {
      const Index a = corners[side], b = corners[(side + 1) % 3];
      if (number[a] == no_index || number[b] == no_index || is_jump(surface, a, b)) continue;
      sets.join(number[a], number[b]);
    }
  }
  return sets;
}

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
  std::vector<Vec3> line;
  for (const Vec3& p : stroke.points) line.push_back(surface.view.R_view_model * (p - surface.centre));
  if (line.empty() || !(stroke.radius > 0)) return {};
  const Near near = points_near(surface, line, stroke.radius);
  DisjointSets sets = connected(surface, near.points);
  const double touching = std::max(2 * surface.rho, stroke.radius / 4);
  std::vector<std::uint8_t> is_touched(near.points.size(), 0);
  for (Index i = 0; i < near.points.size(); ++i)
    if (near.distances[i] <= touching) is_touched[sets.find(i)] = 1;
  StrokeMask mask;
  for (Index i = 0; i < near.points.size(); ++i) {
    if (!is_touched[sets.find(i)]) continue;
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
  Layer layer{stroke, stroke.is_muted ? StrokeMask() : stroke_mask(*surface_, stroke), {}};
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
  std::size_t next = 0;  // after the layer that was kept last, as most strokes keep their order
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
  changed_.clear();
  for (Index i = 0; i < is_changed.size(); ++i)
    if (is_changed[i]) changed_.push_back(i);
}

// Computes what blurs remove, unless it is known for these heights.
template <typename Real>
void StrokeFields<Real>::take_blurs(std::span<const Real> z) {
  const bool is_same = std::ranges::equal(z, blurred_);
  if (!is_same) blurred_.assign(z.begin(), z.end());
  std::vector<StrokeBlur<Real>*> blurs;
  for (Layer& layer : layers_)
    if (layer.blur && !(is_same && !layer.blur->removed().empty())) blurs.push_back(&*layer.blur);
  if (blurs.size() == 1) return blurs[0]->take(z);  // with all threads
  parallel_for(
      blurs.size(), [&](std::size_t i) { blurs[i]->take(z); }, 1);
}

// Adds the changes of the blurs of one width. Several strokes together may not subtract more than there is.
template <typename Real>
void StrokeFields<Real>::add_blurs(bool wide) {
  for (const Index i : changed_) sum_[i] = amount_[i] = 0;
  for (const Layer& layer : layers_) {
    const auto& [stroke, mask, blur] = layer;
    if (!blur || is_wide(stroke.brush) != wide) continue;
    const auto amount = static_cast<Real>(stroke.brush == Brush::soften ? -stroke.amount : stroke.amount);
    for (std::size_t k = 0; k < mask.points.size(); ++k) {
      const Real share = amount * static_cast<Real>(mask.weights[k]);
      amount_[mask.points[k]] += share;
      sum_[mask.points[k]] += share * blur->removed()[k];
    }
  }
  for (const Index i : changed_) added_[i] += sum_[i] / std::max(Real(1), -amount_[i]);
}

template <typename Real>
void StrokeFields<Real>::apply(double height, std::span<Real> z) {
  if (empty()) return;
  take_blurs(z);
  for (std::vector<Real>* each : {&added_, &sum_, &amount_}) each->resize(z.size());
  for (const Index i : changed_) added_[i] = 0;
  for (const bool wide : {false, true}) add_blurs(wide);
  for (const Layer& layer : layers_) {
    const auto& [stroke, mask, blur] = layer;
    if (stroke.brush != Brush::raise && stroke.brush != Brush::sink) continue;
    const auto rise =
        static_cast<Real>(stroke.brush == Brush::raise ? height * stroke.amount : -height * stroke.amount);
    for (std::size_t k = 0; k < mask.points.size(); ++k)
      added_[mask.points[k]] += rise * static_cast<Real>(mask.weights[k]);
  }
  for (const Index i : changed_) z[i] += added_[i];
  for (const Layer& layer : layers_)
    if (layer.stroke.brush == Brush::level && !layer.mask.points.empty())
      level(layer.mask, layer.stroke.amount, z);
  for (const Index i : changed_) z[i] = std::max(z[i], Real(0));
}

template class StrokeFields<float>;
template class StrokeFields<double>;

void apply_strokes(const Surface& surface, Relief& relief) {
  if (!relief.shape.strokes.list) return;
  StrokeFields<double> fields(surface);
  fields.take(*relief.shape.strokes.list);
  fields.apply(relief.height, relief.heights);
  const double height = height_span(relief.heights);
  if (!(height > 0)) return;
  for (double& z : relief.heights) z *= relief.height / height;
}

}  // namespace relievo
