#include "relievo/scan/surface.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <iterator>
#include <optional>

#include "core/memory.h"
#include "geometry/hilbert.h"
#include "geometry/space_curve.h"
#include "relievo/core/parallel.h"
#include "relievo/core/text.h"
#include "relievo/scan/normals.h"
#include "scan/noise/noise.h"
#include "scan/orient_normals.h"
#include "scan/outlines/outline_points.h"
#include "scan/outlines/small_patches.h"

namespace relievo {
namespace {

template <typename T>
std::vector<T> pick(const std::vector<T>& from, std::span<const Index> order) {
  if (from.empty()) return {};
  std::vector<T> out(order.size());
  parallel_for(order.size(), [&](std::size_t i) { out[i] = from[order[i]]; });
  return out;
}

Result<void> check_numbers(const Cloud& cloud) {
  if (cloud.has_normals() && cloud.normals.size() != cloud.size())
    return geometry_error(
        cat("expected a normal for each of ", cloud.size(), " points, found ", cloud.normals.size()));
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (!cloud.points[i].allFinite() || (cloud.has_normals() && !cloud.normals[i].allFinite()))
      return geometry_error(cat("expected finite coordinates and normals, found others at point ", i));
  return {};
}

// Refuses clouds that are a point or a line, up to rounding.
Result<void> check_extent(const Cloud& cloud, const Box& box) {
  if (cloud.size() < 4) return geometry_error(cat("expected at least 4 points, found ", cloud.size()));
  const Vec3 centre = box.centre();
  const double scale = box.diagonal();
  if (!(scale > 0)) return geometry_error("expected points that span a surface, found all of them equal");
  Mat3 covariance = Mat3::Zero();
  for (const Vec3& p : cloud.points) covariance += (p - centre) * (p - centre).transpose() / (scale * scale);
  const Vec3 spread = Eigen::SelfAdjointEigenSolver<Mat3>(covariance, Eigen::EigenvaluesOnly).eigenvalues();
  if (spread[1] <= 1e-14 * spread[2])
    return geometry_error("expected points that span a surface, found all of them on one line");
  return {};
}

void scatter(const std::vector<double>& values, std::span<const Index> places, std::vector<double>& to) {
  for (std::size_t i = 0; i < places.size(); ++i) to[places[i]] = values[i];
}

std::vector<Index> merged(const std::vector<Index>& a, const std::vector<Index>& b) {
  std::vector<Index> both;
  std::merge(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
  return both;
}

// Returns the points in an order in which neighbours in the view plane are close in memory.
std::vector<Index> along_the_plane(const Cloud& viewed, const std::vector<Index>& points) {
  return pick(points, hilbert_order(in_plane(pick(viewed.points, points))));
}

// The whole cloud in view coordinates, with normals, in the order of a space-filling curve.
struct ViewCloud {
  Cloud cloud;
  Spacing spacing;
};

// Estimates normals from more neighbours, as noise needs them, with the signs that they have.
void estimate_again(Cloud& cloud, double noise) {
  constexpr double neighbours = 16, more_neighbours = 48;
  const std::vector<Vec3f> before = cloud.normals;
  estimate_normals(cloud, static_cast<std::size_t>(neighbours + more_neighbours * noise));
  for (std::size_t i = 0; i < before.size(); ++i)
    if (cloud.normals[i].dot(before[i]) < 0) cloud.normals[i] = -cloud.normals[i];
}

// Removes the noise that the view asks for, else the noise that is measured. The spacing stays that of the scan: where
// several scans overlap, points without noise lie closer together than the surface is sampled.
void denoise(ViewCloud& viewed, Surface& surface) {
  surface.measured_noise = measure_noise(viewed.cloud, viewed.spacing);
  surface.removed_noise = surface.view.denoise.value_or(surface.measured_noise);
  if (surface.removed_noise == 0) return;
  if (surface.has_estimated_normals) estimate_again(viewed.cloud, surface.removed_noise);
  remove_noise(viewed.cloud, viewed.spacing, surface.removed_noise);
}

// Stages 1 and 2.
Result<ViewCloud> look_at(const Cloud& cloud, Surface& surface, Progress* progress) {
  if (auto go = begin_stage(progress, "view", 0); !go) return std::unexpected(go.error());
  ViewCloud viewed{in_view(cloud, surface.view), {}};
  // A fixed order makes the result independent of the file's, and neighbours close in memory make all
  // searches faster.
  const std::vector<Index> order = space_curve_order(viewed.cloud.points);
  RELIEVO_CHECK(check_cancelled(progress));
  viewed.cloud = {pick(viewed.cloud.points, order), pick(viewed.cloud.normals, order),
                  pick(viewed.cloud.colours, order), std::move(viewed.cloud.outlines)};

  if (auto go = begin_stage(progress, "spacing", .05); !go) return std::unexpected(go.error());
  viewed.spacing = measure_spacing(viewed.cloud);
  surface.rho = viewed.spacing.rho;
  if (!(surface.rho > 0))
    return geometry_error("expected points at a distance from each other, found most of them equal");

  if (auto go = begin_stage(progress, "normals", .2); !go) return std::unexpected(go.error());
  const OriginalNormals were = orient_normals(viewed.cloud, viewed.spacing, cloud);
  surface.has_estimated_normals = were == OriginalNormals::missing;
  surface.has_flipped_normals = were == OriginalNormals::inward;
  denoise(viewed, surface);
  return viewed;
}

// Stages 3 and 4: sets the surface's points, normals and colours.
Result<PointMeasures> find_points(ViewCloud& viewed, const SurfaceOptions& options, Surface& surface,
                                  Progress* progress) {
  if (auto go = begin_stage(progress, "visible points", .3); !go) return std::unexpected(go.error());
  auto& [cloud, spacing] = viewed;
  const auto [visible, removed] = find_visible(cloud, spacing, options.visible);
  if (visible.size() < 4)
    return geometry_error(
        cat("expected at least 4 points that face the viewer, found ", visible.size(), "; try another view"));
  surface.visible_points = visible.size();
  surface.removed_points = removed;
  RELIEVO_CHECK(check_cancelled(progress));
  const std::vector<Index> hole_fill = hole_fill_points(cloud, spacing, visible, options.visible);
  // Flat, as nothing is known of the front there.
  for (const Index i : hole_fill) cloud.normals[i] = Vec3f::UnitZ();

  if (auto go = begin_stage(progress, "curvature", .4); !go) return std::unexpected(go.error());
  std::vector<double> k(cloud.size(), 0.0);
  scatter(mean_curvature(cloud, spacing, visible, options.curvature, progress), visible, k);
  RELIEVO_CHECK(check_cancelled(progress));
  const std::vector<Index> shown = along_the_plane(cloud, merged(visible, hole_fill));
  surface.points = pick(cloud.points, shown);
  surface.normals = pick(cloud.normals, shown);
  surface.colours = pick(cloud.colours, shown);
  return PointMeasures{pick(k, shown), spacing.is_uneven ? pick(spacing.local, shown) : std::vector<float>()};
}

// Stages 5 and 6.
Result<void> triangulate(Surface& surface, const PointMeasures& measures, const BoundaryOptions& options,
                         Progress* progress) {
  const std::vector<Vec2> xy = in_plane(surface.points);
  surface.triangulation = delaunay(xy);
  if (surface.triangulation.triangles.empty())
    return geometry_error("expected visible points that enclose an area, found all of them on one line");
  surface.boundary = find_boundary(xy, surface.triangulation, surface.rho, options, measures.spacing);
  return check_cancelled(progress);
}

}  // namespace

std::size_t Surface::memory() const {
  return bytes(points) + bytes(normals) + bytes(curvature.k) + bytes(triangulation.triangles) +
         bytes(triangulation.hull) + bytes(boundary.is_inside) + bytes(boundary.is_boundary) +
         bytes(boundary.distance);
}

std::vector<Vec2> in_plane(std::span<const Vec3> points) {
  std::vector<Vec2> xy(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) xy[i] = points[i].head<2>();
  return xy;
}

Result<Surface> find_surface(const Cloud& whole, const View& view, const SurfaceOptions& options,
                             Progress* progress) {
  if (auto ok = check_numbers(whole); !ok) return std::unexpected(ok.error());
  std::optional<Cloud> part;
  if (view.crop != Crop{}) {
    part = cropped(whole, view);
    if (part->size() < 4)
      return option_error("crop", cat("expected a part with at least 4 points, found ", part->size()));
  }
  const Cloud& cloud = part ? *part : whole;
  const Box box = bounds(cloud);
  if (auto ok = check_extent(cloud, box); !ok) return std::unexpected(ok.error());
  Surface surface;
  surface.view = view;
  surface.centre = box.centre();
  surface.diagonal = box.diagonal();
  surface.input_points = whole.size();

  Result<ViewCloud> viewed = look_at(cloud, surface, progress);
  if (!viewed) return std::unexpected(viewed.error());
  RELIEVO_TRY(PointMeasures measures, find_points(*viewed, options, surface, progress));

  if (auto go = begin_stage(progress, "triangulation", .6); !go) return std::unexpected(go.error());
  RELIEVO_CHECK(triangulate(surface, measures, options.boundary, progress));
  if (auto go = begin_stage(progress, "boundary", .65); !go) return std::unexpected(go.error());
  if (drop_small_patches(surface, measures))
    RELIEVO_CHECK(triangulate(surface, measures, options.boundary, progress));
  put_points_on_outlines(surface, measures, viewed->cloud.outlines);
  RELIEVO_CHECK(check_cancelled(progress));
  surface.curvature = normalise(average_in_plane(measures.k, in_plane(surface.points), surface.normals,
                                                 surface.triangulation, surface.rho));
  // Only the boundary needs the neighbours; they take as much memory as the triangles.
  surface.triangulation.neighbours = std::vector<Triangle>();
  return surface;
}

}  // namespace relievo
