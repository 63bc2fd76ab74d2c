#include "relief/stroke_fields.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/disjoint_sets.h"
#include "core/height_span.h"
#include "geometry/edges.h"
#include "relief/edge_weight.h"
#include "relievo/relief/weights.h"
#include "scan/jumps.h"

namespace relievo {
namespace {

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a;
  const double length_sq = along.squaredNorm();
  const double t = length_sq > 0 ? std::clamp((p - a).dot(along) / length_sq, 0.0, 1.0) : 0;
  return (p - a - t * along).norm();
}

double distance_to_line(const Vec3& p, std::span<const Vec3> line) {
  double least = (p - line.front()).norm();
  for (std::size_t i = 1; i < line.size(); ++i)
    least = std::min(least, distance_to_segment(p, line[i - 1], line[i]));
  return least;
}

// The points within the radius of a line, and their distances from it.
struct Near {
  std::vector<Index> points;
  std::vector<double> distances;
};

Near points_near(const Surface& surface, std::span<const Vec3> line, double radius) {
  Box box;
  for (const Vec3& p : line) box.extend(p);
  const Vec3 least = box.min.array() - radius, most = box.max.array() + radius;
  Near near;
  for (Index i = 0; i < surface.points.size(); ++i) {
    const Vec3& p = surface.points[i];
    if ((p.array() < least.array()).any() || (p.array() > most.array()).any()) continue;
    if (surface.boundary.is_boundary[i]) continue;
    const double distance = distance_to_line(p, line);
    if (distance >= radius) continue;
    near.points.push_back(i);
    near.distances.push_back(distance);
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

// Returns a third of the area of the triangles around each point, in the view plane.
std::vector<float> point_areas(const Surface& surface) {
  std::vector<float> areas(surface.points.size(), 0);
  for (std::size_t t = 0; t < surface.triangulation.triangles.size(); ++t) {
    if (!surface.boundary.is_inside[t]) continue;
    const auto& [a, b, c] = surface.triangulation.triangles[t];
    const Vec3 ab = surface.points[b] - surface.points[a], ac = surface.points[c] - surface.points[a];
    const auto third = static_cast<float>((ab.x() * ac.y() - ab.y() * ac.x()) / 6);
    for (const Index i : {a, b, c}) areas[i] += third;
  }
  return areas;
}

// Returns the amount per point by which z minus the blur of z is added.
std::vector<float> blur_amounts(std::size_t points, const Strokes& strokes, std::span<const StrokeMask> masks,
                                bool is_wide) {
  std::vector<float> amounts;
  for (std::size_t s = 0; s < strokes.size(); ++s) {
    const Brush brush = strokes[s].brush;
    const bool is_blur =
        is_wide ? brush == Brush::strengthen : brush == Brush::sharpen || brush == Brush::soften;
    if (!is_blur || masks[s].points.empty()) continue;
    amounts.resize(points, 0);
    const auto amount = static_cast<float>(brush == Brush::soften ? -strokes[s].amount : strokes[s].amount);
    for (std::size_t k = 0; k < masks[s].points.size(); ++k)
      amounts[masks[s].points[k]] += amount * masks[s].weights[k];
  }
  // Several strokes together must not subtract more than the whole difference.
  for (float& amount : amounts) amount = std::max(amount, -1.F);
  return amounts;
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
typename StrokeFields<Real>::Blur StrokeFields<Real>::blur_of(double sigma,
                                                              std::span<const float> amounts) const {
  const Surface& surface = *surface_;
  Blur blur;
  std::vector<Index> number(surface.points.size(), no_index);
  std::vector<Vec2> places;
  for (Index i = 0; i < amounts.size(); ++i) {
    if (amounts[i] == 0) continue;
    number[i] = static_cast<Index>(blur.points.size());
    blur.points.push_back(i);
    blur.amounts.push_back(amounts[i]);
    places.emplace_back(surface.points[i].head<2>());
  }
  const std::vector<float> areas = point_areas(surface);
  const auto is_wanted = [&](const TriangleSide& side) {
    return surface.boundary.is_inside[side.triangle] && !is_jump(surface, side.from, side.to) &&
           (number[side.from] != no_index || number[side.to] != no_index);
  };
  // Two solves, each with half of the variance, approximate a Gaussian better than one solve.
  const double variance = sigma * sigma / 4;
  std::vector<Eigen::Triplet<double>> entries;
  each_edge(surface.triangulation.triangles, is_wanted, [&](std::span<const TriangleSide> sides) {
    const Index a = sides[0].low(), b = sides[0].high();
    const double pull = variance * static_cast<double>(edge_weight(surface.points, sides));
    blur.links.push_back({a, b, static_cast<float>(pull)});
    for (const Index end : {a, b})
      if (number[end] != no_index) entries.emplace_back(number[end], number[end], pull);
    if (number[a] != no_index && number[b] != no_index)
      entries.emplace_back(std::max(number[a], number[b]), std::min(number[a], number[b]), -pull);
  });
  const auto least_area = static_cast<float>(1e-3 * surface.rho * surface.rho);
  for (Index i = 0; i < blur.points.size(); ++i) {
    blur.areas.push_back(std::max(areas[blur.points[i]], least_area));
    entries.emplace_back(i, i, static_cast<double>(blur.areas[i]));
  }
  const auto size = static_cast<int>(blur.points.size());
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  // The matrix is diagonally dominant, so factoring succeeds.
  if (Result<solver::Cholesky> system = solver::Cholesky::factor(matrix, places)) {
    blur.system.emplace(std::move(*system));
    blur.system->renumber(blur.points);
    blur.workspace.emplace(blur.system->make_workspace());
  }
  return blur;
}

template <typename Real>
void StrokeFields<Real>::take_masks(const Strokes& strokes) {
  std::vector<StrokeMask> masks;
  for (const Stroke& stroke : strokes) {
    const auto old = std::ranges::find(strokes_, stroke);
    if (old != strokes_.end())
      masks.push_back(masks_[static_cast<std::size_t>(old - strokes_.begin())]);
    else
      masks.push_back(stroke.is_muted ? StrokeMask() : stroke_mask(*surface_, stroke));
  }
  strokes_ = strokes;
  masks_ = std::move(masks);
}

template <typename Real>
void StrokeFields<Real>::take_raised() {
  raised_.assign(surface_->points.size(), 0);
  for (std::size_t s = 0; s < strokes_.size(); ++s) {
    const Brush brush = strokes_[s].brush;
    if (brush != Brush::raise && brush != Brush::sink) continue;
    const auto amount = static_cast<float>(brush == Brush::raise ? strokes_[s].amount : -strokes_[s].amount);
    for (std::size_t k = 0; k < masks_[s].points.size(); ++k)
      raised_[masks_[s].points[k]] += amount * masks_[s].weights[k];
  }
}

template <typename Real>
void StrokeFields<Real>::take(const Strokes& strokes) {
  if (strokes == strokes_) return;
  take_masks(strokes);
  take_raised();
  std::set<Index> changed;
  levels_.clear();
  for (std::size_t s = 0; s < strokes_.size(); ++s) {
    changed.insert(masks_[s].points.begin(), masks_[s].points.end());
    if (strokes_[s].brush == Brush::level && !masks_[s].points.empty()) levels_.push_back(s);
  }
  changed_.assign(changed.begin(), changed.end());
  blurs_.clear();
  for (const bool is_wide : {false, true}) {
    const std::vector<float> amounts = blur_amounts(raised_.size(), strokes_, masks_, is_wide);
    const double sigma = (is_wide ? wide_blur : narrow_blur) * surface_->longer_side();
    if (!amounts.empty()) blurs_.push_back(blur_of(sigma, amounts));
  }
}

// Let g = z + e be the blurred heights; e is 0 around the points. Then areas (g - z) = -variance L g becomes
// a system for e: (areas + variance L) e = -variance L z. The second solve blurs g instead of z.
template <typename Real>
void StrokeFields<Real>::add_removed(Blur& blur, std::span<const Real> z) {
  if (!blur.system) return;
  pulled_.assign(z.size(), 0);
  moved_.resize(z.size());
  for (const auto& [a, b, pull] : blur.links) {
    const Real difference = static_cast<Real>(pull) * (z[b] - z[a]);
    pulled_[a] += difference;
    pulled_[b] -= difference;
  }
  const auto solve = [&] {
    blur.system->solve(std::span<const Real>(pulled_), std::span<Real>(moved_), *blur.workspace);
  };
  solve();
  for (std::size_t k = 0; k < blur.points.size(); ++k)
    pulled_[blur.points[k]] += static_cast<Real>(blur.areas[k]) * moved_[blur.points[k]];
  solve();
  for (std::size_t k = 0; k < blur.points.size(); ++k)
    added_[blur.points[k]] -= static_cast<Real>(blur.amounts[k]) * moved_[blur.points[k]];
}

template <typename Real>
void StrokeFields<Real>::apply(double height, std::span<Real> z) {
  if (empty()) return;
  added_.assign(z.size(), 0);
  for (Blur& blur : blurs_) add_removed(blur, z);
  for (const Index i : changed_)
    z[i] += added_[i] + static_cast<Real>(height) * static_cast<Real>(raised_[i]);
  for (const std::size_t s : levels_) level(masks_[s], strokes_[s].amount, z);
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
