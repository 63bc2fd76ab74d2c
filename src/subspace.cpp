#include "relievo/subspace.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "disjoint_sets.h"
#include "neighbours.h"
#include "relievo/detail.h"
#include "relievo/parallel.h"

namespace relievo {
namespace {

std::vector<Vec2> in_plane(std::span<const Vec3> points) {
  std::vector<Vec2> xy(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) xy[i] = points[i].head<2>();
  return xy;
}

template <typename T>
std::vector<T> pick(const std::vector<T>& from, std::span<const Index> which) {
  std::vector<T> out(which.size());
  for (std::size_t i = 0; i < which.size(); ++i) out[i] = from[which[i]];
  return out;
}

double cross(const Vec2& u, const Vec2& v) {
  return u.x() * v.y() - u.y() * v.x();
}

// Finds triangles by walking from the last one found.
class Walker {
 public:
  Walker(std::span<const Vec2> points, const Triangulation& mesh) : points_(points), mesh_(mesh) {}

  // A triangle that holds p, no_index outside the hull.
  Index find(const Vec2& p) {
    Index t = last_;
    for (std::size_t step = 0; step < mesh_.triangles.size(); ++step) {
      last_ = t;
      const int across = edge_towards(t, p);
      if (across < 0) return t;
      t = mesh_.neighbours[t][static_cast<std::size_t>(across)];
      if (t == no_index) return no_index;
    }
    return no_index;
  }

 private:
  // The corner whose opposite edge has p most clearly on its far side, -1 if none.
  int edge_towards(Index t, const Vec2& p) const {
    int worst = -1;
    double least = 0;
    for (int i = 0; i < 3; ++i) {
      const Vec2& a = points_[mesh_.triangles[t][static_cast<std::size_t>(i + 1) % 3]];
      const Vec2& b = points_[mesh_.triangles[t][static_cast<std::size_t>(i + 2) % 3]];
      const double side = cross(b - a, p - a) / (b - a).norm();
      if (side < least) least = side, worst = i;
    }
    return worst;
  }

  std::span<const Vec2> points_;
  const Triangulation& mesh_;
  Index last_ = 0;
};

// A triangle of control points belongs to the relief if most of its area does: every triangle of all points is
// asked for.
std::vector<std::uint8_t> covered(std::span<const Vec2> control, const Triangulation& mesh,
                                  std::span<const Vec2> points, const Surface& surface) {
  std::vector<double> inside_area(mesh.triangles.size(), 0.0);
  Walker walker(control, mesh);
  for (std::size_t t = 0; t < surface.triangulation.triangles.size(); ++t) {
    if (!surface.boundary.is_inside[t]) continue;
    const auto [a, b, c] = surface.triangulation.triangles[t];
    const Index found = walker.find((points[a] + points[b] + points[c]) / 3);
    if (found != no_index)
      inside_area[found] += cross(points[b] - points[a], points[c] - points[a]);
  }
  std::vector<std::uint8_t> is_inside(mesh.triangles.size());
  for (std::size_t t = 0; t < is_inside.size(); ++t) {
    const auto [a, b, c] = mesh.triangles[t];
    is_inside[t] = inside_area[t] > .5 * cross(control[b] - control[a], control[c] - control[a]);
  }
  return is_inside;
}

Boundary control_boundary(const ControlPoints& control, const Triangulation& mesh,
                          std::vector<std::uint8_t> is_inside) {
  const std::size_t n = control.points.size();
  std::vector<std::uint8_t> is_boundary(n, 0), is_used(n, 0), is_at_edge(n, 0), is_held(n, 0);
  for (std::size_t i = 0; i < control.boundary_points; ++i) is_boundary[i] = 1;
  DisjointSets pieces(n);
  for (std::size_t t = 0; t < is_inside.size(); ++t) {
    const auto [a, b, c] = mesh.triangles[t];
    for (const Index i : mesh.triangles[t]) (is_inside[t] ? is_used : is_at_edge)[i] = 1;
    if (is_inside[t]) pieces.join(a, b), pieces.join(b, c);
  }
  for (const Index i : mesh.hull) is_at_edge[i] = 1;
  for (Index i = 0; i < n; ++i)
    if (is_boundary[i]) is_held[pieces.find(i)] = 1;
  for (Index i = 0; i < n; ++i)
    if (!is_used[i] || (is_at_edge[i] && !is_held[pieces.find(i)])) is_boundary[i] = 1;
  return {std::move(is_inside), std::move(is_boundary), {}};
}

constexpr Compression keep_all{std::numeric_limits<double>::infinity(), 0};

// The points nearest to each control point, at most `most` of them, spread evenly over the list of the region.
struct Regions {
  std::vector<Index> begin;  // of control point c in `points`
  std::vector<Index> points;
};

Regions regions_of(std::span<const Vec2> points, const ControlPoints& control, std::size_t most) {
  const std::vector<Vec2> centres = [&] {
    std::vector<Vec2> out;
    for (const Index i : control.points) out.push_back(points[i]);
    return out;
  }();
  const KdTree<Vec2> tree(centres);
  std::vector<Index> nearest(points.size());
  parallel_for(points.size(), [&](std::size_t i) {
    double distance_sq;
    tree.nearest(points[i], 1, &nearest[i], &distance_sq);
  });
  std::vector<std::vector<Index>> lists(centres.size());
  for (Index i = 0; i < points.size(); ++i) lists[nearest[i]].push_back(i);
  Regions regions;
  for (std::size_t c = 0; c < lists.size(); ++c) {
    regions.begin.push_back(static_cast<Index>(regions.points.size()));
    if (most <= 1 || lists[c].empty()) {
      regions.points.push_back(control.points[c]);
      continue;
    }
    const std::size_t n = std::min(most, lists[c].size());
    for (std::size_t k = 0; k < n; ++k) regions.points.push_back(lists[c][(2 * k + 1) * lists[c].size() / (2 * n)]);
  }
  regions.begin.push_back(static_cast<Index>(regions.points.size()));
  return regions;
}

Result<std::vector<double>> reference_heights(const Surface& surface, std::span<const Vec2> points,
                                              std::span<const float> boundary_weight, double max_slope) {
  const Result<HeightSystem> system = HeightSystem::build(points, surface.triangulation, surface.boundary);
  if (!system) return std::unexpected(system.error());
  std::vector<Vec2> slopes(points.size());
  compressed_slopes({surface.normals, surface.curvature.k, boundary_weight, surface.curvature.delta}, keep_all,
                    max_slope, slopes);
  std::vector<double> heights(points.size());
  system->solve(slopes, heights);
  return heights;
}

}  // namespace

Result<SubspaceModel> SubspaceModel::prepare(const Surface& surface, const SubspaceOptions& options,
                                             std::span<const double> reference, Progress* progress) {
  if (auto go = begin_stage(progress, "control points", .75); !go) return std::unexpected(go.error());
  const std::vector<Vec2> points = in_plane(surface.points);
  std::vector<float> boundary_weight = boundary_weights(surface.boundary.distance, surface.rho);
  std::vector<double> solved;
  if (reference.empty()) {
    auto heights = reference_heights(surface, points, boundary_weight, options.max_slope);
    if (!heights) return std::unexpected(heights.error());
    solved = std::move(*heights);
    reference = solved;
  }

  ControlPoints control = grow_control_points(points, surface.boundary.distance, options.control);
  const std::vector<Vec2> sites = pick(points, control.points);
  const Triangulation mesh = delaunay(sites);
  Result<HeightSystem> system =
      HeightSystem::build(sites, mesh, control_boundary(control, mesh, covered(sites, mesh, points, surface)));
  if (!system) return std::unexpected(system.error());

  const Regions regions = regions_of(points, control, options.normals_per_point);
  const std::vector<Vec3f> region_normals = pick(surface.normals, regions.points);
  const std::vector<float> region_k = pick(surface.curvature.k, regions.points);
  const std::vector<float> region_w = pick(boundary_weight, regions.points);

  SplineOptions so;
  so.min = so.max = points[0];
  for (const Vec2& p : points) so.min = so.min.cwiseMin(p), so.max = so.max.cwiseMax(p);
  so.cell = options.cell * std::max(control.radius, 1e-3 * (so.max - so.min).maxCoeff());
  so.levels = options.levels;
  so.damping = options.damping;

  // z0_c
  std::vector<Vec2> ns(region_normals.size()), cs(sites.size());
  compressed_slopes({region_normals, region_k, region_w, surface.curvature.delta}, keep_all, options.max_slope, ns);
  auto average = [&] {
    for (std::size_t c = 0; c < cs.size(); ++c) {
      Vec2 sum = Vec2::Zero();
      for (Index i = regions.begin[c]; i < regions.begin[c + 1]; ++i) sum += ns[i];
      cs[c] = sum / static_cast<double>(regions.begin[c + 1] - regions.begin[c]);
    }
  };
  average();
  std::vector<double> z0c(sites.size());
  system->solve(cs, z0c);
  const double level = options.level_ratio * height_span(z0c);
  std::vector<float> weights(sites.size());
  for (std::size_t c = 0; c < weights.size(); ++c)
    weights[c] = static_cast<float>(std::pow(z0c[c] * z0c[c] + 1e-12 * level * level, options.weight_power / 2));

  SubspaceModel model(std::move(*system), MultilevelSpline(sites, weights, so));
  model.control_ = std::move(control);
  model.region_begin_ = regions.begin;
  model.region_normals_ = region_normals;
  model.region_k_ = region_k;
  model.region_boundary_weight_ = region_w;
  model.delta_ = surface.curvature.delta;
  model.control_reference_ = z0c;
  model.level_sq_ = level * level;
  model.places_ = model.spline_.pack(points);
  model.reference_.assign(reference.begin(), reference.end());
  model.k_ = surface.curvature.k;
  model.boundary_weight_ = std::move(boundary_weight);
  return model;
}

SubspaceModel::Workspace SubspaceModel::make_workspace() const {
  const std::size_t n = control_.points.size();
  return {std::vector<Vec2>(region_k_.size()), std::vector<Vec2>(n), std::vector<double>(n),
          std::vector<float>(n), spline_.make_function(), spline_.make_workspace()};
}

void SubspaceModel::solve(const Shape& shape, Workspace& w) const {
  compressed_slopes({region_normals_, region_k_, region_boundary_weight_, delta_}, shape.compression, shape.max_slope,
                    w.normal_slopes);
  parallel_for(w.slopes.size(), [&](std::size_t c) {
    Vec2 sum = Vec2::Zero();
    for (Index i = region_begin_[c]; i < region_begin_[c + 1]; ++i) sum += w.normal_slopes[i];
    w.slopes[c] = sum / static_cast<double>(region_begin_[c + 1] - region_begin_[c]);
  });
  system_.solve(w.slopes, w.heights);
}

void SubspaceModel::heights(const Shape& shape, Workspace& w, std::span<float> heights) const {
  solve(shape, w);
  double zz = 0, z0z0 = 0;
  for (std::size_t c = 0; c < w.heights.size(); ++c) {
    zz += w.heights[c] * control_reference_[c];
    z0z0 += control_reference_[c] * control_reference_[c];
  }
  const double overall = z0z0 > 0 ? zz / z0z0 : 0;
  for (std::size_t c = 0; c < w.heights.size(); ++c) {
    const double z0 = control_reference_[c];
    w.ratios[c] = static_cast<float>((w.heights[c] * z0 + level_sq_ * overall) / std::max(z0 * z0 + level_sq_, 1e-300));
  }
  spline_.fit(w.ratios, w.function, w.fit);
  parallel_ranges(heights.size(), default_grain, [&](std::size_t begin, std::size_t end) {
    spline_.evaluate(w.function, std::span(places_).subspan(begin, end - begin), heights.subspan(begin, end - begin));
    for (std::size_t i = begin; i < end; ++i) heights[i] *= reference_[i];
  });
}

Relief SubspaceModel::make(const Shape& shape) const {
  Workspace workspace = make_workspace();
  std::vector<float> z(size());
  heights(shape, workspace, z);
  Relief relief{std::vector<double>(z.begin(), z.end()), 0, shape};
  add_detail(relief.heights, {k_, boundary_weight_, shape.gamma});
  relief.height = height_span(relief.heights);
  return relief;
}

}  // namespace relievo
