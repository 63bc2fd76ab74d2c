#include "stock_pipeline.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include "relievo/relief/control_points.h"
#include "relievo/scan/surface.h"
#include "scan/jumps.h"

namespace relievo {
namespace {

class Stopwatch {
 public:
  // Milliseconds since the last call.
  double lap() {
    const auto before = std::exchange(start_, std::chrono::steady_clock::now());
    return std::chrono::duration<double, std::milli>(start_ - before).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

const Shape keep_all{{std::numeric_limits<double>::infinity(), 0}};

std::vector<Index> all_points(const Surface& surface) {
  std::vector<Index> all(surface.points.size());
  for (Index i = 0; i < all.size(); ++i) all[i] = i;
  return all;
}

HeightEquations equations_of(const Surface& surface) {
  return height_equations(in_plane(surface.points), surface.triangulation, surface.boundary,
                          jump_weights(surface));
}

std::array<double, 4> basis(double t) {
  const double s = 1 - t;
  return {s * s * s / 6, (3 * t * t * t - 6 * t * t + 4) / 6, (-3 * t * t * t + 3 * t * t + 3 * t + 1) / 6,
          t * t * t / 6};
}

}  // namespace

StockHeights::StockHeights(HeightEquations equations, const Surface& surface, std::vector<Index> points)
    : equations_(std::move(equations)),
      surface_(surface),
      points_(std::move(points)),
      boundary_weight_(boundary_weights(surface.boundary.distance, surface.rho)),
      system_(equations_.A, CHOLMOD_AMD),
      slopes_(points_.size()),
      b_(equations_.free_points.size()),
      heights_(points_.size(), 0.0) {}

const std::vector<double>& StockHeights::solve(const Shape& shape) {
  for (std::size_t c = 0; c < points_.size(); ++c) {
    const Index i = points_[c];
    const double w = curvature_weight(static_cast<double>(surface_.curvature.k[i]), surface_.curvature.delta,
                                      shape.compression);
    slopes_[c] = compressed_slope(surface_.normals[i].cast<double>(),
                                  w * static_cast<double>(boundary_weight_[i]), shape.max_slope);
  }
  for (std::size_t f = 0; f < b_.size(); ++f) {
    const Index i = equations_.free_points[f];
    b_[f] = 0;
    for (Index e = equations_.begin[i]; e < equations_.begin[i + 1]; ++e)
      b_[f] += (slopes_[i] + slopes_[equations_.edges[e].other])
                   .dot(equations_.edges[e].coefficient.cast<double>());
  }
  const std::span<const double> x = system_.solve(b_);
  for (std::size_t f = 0; f < b_.size(); ++f) heights_[equations_.free_points[f]] = x[f];
  return heights_;
}

StockSpline::StockSpline(std::vector<Vec2> sites, double coarsest_cell, int levels)
    : sites_(std::move(sites)), min_(sites_[0]), max_(sites_[0]) {
  for (const Vec2& p : sites_) min_ = min_.cwiseMin(p), max_ = max_.cwiseMax(p);
  double cell = coarsest_cell;
  for (int l = 0; l < levels; ++l, cell /= 2) {
    const Vec2 cells = (max_ - min_) / cell;
    const auto columns = static_cast<std::size_t>(cells.x()) + 4,
               rows = static_cast<std::size_t>(cells.y()) + 4;
    lattices_.push_back({cell, columns, rows, std::vector<double>(columns * rows)});
  }
}

double StockSpline::value(const Lattice& lattice, const Vec2& offset) {
  const Vec2 at = offset / lattice.cell;
  const auto column = static_cast<std::size_t>(at.x()), row = static_cast<std::size_t>(at.y());
  const auto x = basis(at.x() - static_cast<double>(column)), y = basis(at.y() - static_cast<double>(row));
  double sum = 0;
  for (std::size_t l = 0; l < 4; ++l)
    for (std::size_t k = 0; k < 4; ++k)
      sum += x[k] * y[l] * lattice.nodes[(row + l) * lattice.columns + column + k];
  return sum;
}

void StockSpline::fit(Lattice& lattice, const std::vector<double>& rest) const {
  std::vector<double> above(lattice.nodes.size(), 0.0), below(lattice.nodes.size(), 0.0);
  for (std::size_t i = 0; i < sites_.size(); ++i) {
    const Vec2 at = (sites_[i] - min_) / lattice.cell;
    const auto column = static_cast<std::size_t>(at.x()), row = static_cast<std::size_t>(at.y());
    const auto x = basis(at.x() - static_cast<double>(column)), y = basis(at.y() - static_cast<double>(row));
    double squares = 0;
    for (const double wx : x)
      for (const double wy : y) squares += wx * wx * wy * wy;
    for (std::size_t l = 0; l < 4; ++l)
      for (std::size_t k = 0; k < 4; ++k) {
        const double w = x[k] * y[l];
        above[(row + l) * lattice.columns + column + k] += w * w * w * rest[i] / squares;
        below[(row + l) * lattice.columns + column + k] += w * w;
      }
  }
  for (std::size_t i = 0; i < above.size(); ++i) lattice.nodes[i] = below[i] > 0 ? above[i] / below[i] : 0;
}

void StockSpline::fit(std::vector<double> values) {
  for (Lattice& lattice : lattices_) {
    fit(lattice, values);
    for (std::size_t i = 0; i < sites_.size(); ++i) values[i] -= value(lattice, sites_[i] - min_);
  }
}

double StockSpline::operator()(const Vec2& place) const {
  const Vec2 offset = place.cwiseMax(min_).cwiseMin(max_) - min_;
  double sum = 0;
  for (const Lattice& lattice : lattices_) sum += value(lattice, offset);
  return sum;
}

StockPipeline::StockPipeline(const Surface& surface)
    : surface_(surface),
      points_(in_plane(surface.points)),
      heights_(std::make_unique<StockHeights>(equations_of(surface), surface, all_points(surface))),
      z_(points_.size()),
      boundary_weight_(boundary_weights(surface.boundary.distance, surface.rho)),
      normals_(points_.size()) {}

StockPipeline::StockPipeline(const Surface& surface, const ControlPoints& control) : StockPipeline(surface) {
  reference_ = heights_->solve(keep_all);
  const ControlMesh mesh = mesh_control_points(surface, control);
  const std::vector<float> weights = jump_weights(surface);
  std::vector<float> control_weights;
  for (const Index p : control.points) control_weights.push_back(weights[p]);
  heights_ = std::make_unique<StockHeights>(
      height_equations(mesh.points, mesh.triangulation, mesh.boundary, control_weights), surface,
      control.points);
  control_reference_ = heights_->solve(keep_all);
  spline_ = std::make_unique<StockSpline>(mesh.points, 12 * control.radius, 5);
}

StockTimes StockPipeline::make(const Shape& shape) {
  StockTimes times;
  Stopwatch watch;
  solved_ = &heights_->solve(shape);
  times.t1 = watch.lap();
  spline_ ? map() : static_cast<void>(z_ = *solved_);
  add_detail(shape.gamma);
  times.t2 = watch.lap();
  find_normals();
  times.t3 = watch.lap();
  return times;
}

void StockPipeline::map() {
  const auto [low, high] = std::minmax_element(control_reference_.begin(), control_reference_.end());
  const double faint = 1e-3 * (*high - *low);
  std::vector<double> ratios(control_reference_.size());
  for (std::size_t c = 0; c < ratios.size(); ++c) {
    const double z0 = control_reference_[c];
    ratios[c] = (*solved_)[c] * z0 / (z0 * z0 + faint * faint);
  }
  spline_->fit(ratios);
  for (std::size_t i = 0; i < z_.size(); ++i) z_[i] = reference_[i] * (*spline_)(points_[i]);
}

void StockPipeline::add_detail(double gamma) {
  const auto [low, high] = std::minmax_element(z_.begin(), z_.end());
  const double amount = gamma * (*high - *low);
  for (std::size_t i = 0; i < z_.size(); ++i)
    z_[i] += amount * static_cast<double>(surface_.curvature.k[i]) * static_cast<double>(boundary_weight_[i]);
}

void StockPipeline::find_normals() {
  std::fill(normals_.begin(), normals_.end(), Vec3::Zero());
  const auto at = [&](Index i) { return Vec3(points_[i].x(), points_[i].y(), z_[i]); };
  for (std::size_t t = 0; t < surface_.triangulation.triangles.size(); ++t) {
    if (!surface_.boundary.is_inside[t]) continue;
    const auto [a, b, c] = surface_.triangulation.triangles[t];
    const Vec3 u = at(b) - at(a), v = at(c) - at(a);
    const Vec3 cross(u.y() * v.z() - u.z() * v.y(), u.z() * v.x() - u.x() * v.z(),
                     u.x() * v.y() - u.y() * v.x());
    for (const Index corner : {a, b, c}) normals_[corner] += cross;
  }
  for (Vec3& normal : normals_) normal.normalize();
}

}  // namespace relievo
