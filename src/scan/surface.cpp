#include "relievo/scan/surface.h"

#include <algorithm>
#include <iterator>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/disjoint_sets.h"
#include "core/lists.h"
#include "core/memory.h"
#include "geometry/hilbert.h"
#include "relievo/core/parallel.h"
#include "relievo/core/text.h"
#include "relievo/scan/cloud.h"
#include "relievo/scan/normals.h"
#include "relievo/scan/spacing.h"
#include "scan/coarse_visibility.h"
#include "scan/depth/flat_picture.h"
#include "scan/measured_cloud.h"
#include "scan/noise/noise.h"
#include "scan/outlines/outline_points.h"

namespace relievo {
namespace {

// The indices of a cloud's points that become points of the surface.
struct ShownPoints {
  std::vector<Index>& visible;
  std::vector<Index>& hole_fill;
};

// A connected part of the points that remain when the plane is removed.
struct ComponentExtent {
  Box box;
  std::size_t high = 0;
};

// Removes remains of a plane: parts that rise little above the plane compared with their size. Such parts
// remain because depth cameras bend tables, and because boards have ridges. Also removes debris: parts that
// are much smaller than the largest part.
void drop_low_components(const SupportPlane& plane, const Cloud& cloud, const Spacing& spacing,
                         std::vector<Index>& visible) {
  // A point is high if its height above the plane exceeds `low` tolerances of the plane, and the share `flat` of the
  // diagonal of its component's box.
  constexpr double low = 4;
  constexpr double flat = .05;
  constexpr double connected = 3;    // neighbours closer than this, in local spacings, are in one component
  constexpr double high_share = .1;  // least share of high points in a part that is kept
  // Size of the smallest part that is kept, as a share of the largest part.
  constexpr double debris_share = .03;
  std::vector<std::uint8_t> is_left(cloud.size(), 0);
  for (const Index i : visible) is_left[i] = 1;
  DisjointSets sets(cloud.size());
  for (const Index i : visible)
    for (const Index j : spacing.nearest[i])
      if (j != no_index && is_left[j] &&
          (cloud.points[i] - cloud.points[j]).norm() < connected * static_cast<double>(spacing.local[i]))
        sets.join(i, j);
  std::unordered_map<Index, ComponentExtent> components;  // by the representatives of their sets
  for (const Index i : visible) components[sets.find(i)].box.extend(cloud.points[i]);
  for (const Index i : visible) {
    ComponentExtent& component = components[sets.find(i)];
    const double height = plane.normal.dot(cloud.points[i]) - plane.offset;
    component.high += height > std::max(low * plane.tolerance, flat * component.box.diagonal());
  }
  std::vector<Index> rest;
  for (const Index i : visible)
    if (static_cast<double>(components[sets.find(i)].high) >=
        high_share * static_cast<double>(sets.size_of(i)))
      rest.push_back(i);
  std::size_t largest = 0;
  for (const Index i : rest) largest = std::max(largest, sets.size_of(i));
  const double least = debris_share * static_cast<double>(largest);
  std::erase_if(rest, [&](Index i) { return static_cast<double>(sets.size_of(i)) < least; });
  if (!rest.empty()) visible = std::move(rest);
}

// Removes from the shown points those of the plane, parts that rise little above the plane, and debris. Also
// removes outlines in the plane from the cloud.
void leave_out_plane(const SupportPlane& plane, const Spacing& spacing, Cloud& cloud,
                     const ShownPoints& shown) {
  const auto is_taken = [&](Index i) { return plane.takes(cloud.points[i], cloud.normals[i]); };
  std::erase_if(shown.visible, is_taken);
  std::erase_if(shown.hole_fill, is_taken);
  const Vec3f normal = plane.normal.cast<float>();
  std::erase_if(cloud.outlines, [&](const OutlineSegment& s) {
    return plane.takes(s.from, normal) && plane.takes(s.to, normal);
  });
  drop_low_components(plane, cloud, spacing, shown.visible);
}

void scatter(const std::vector<double>& values, std::span<const Index> places, std::vector<double>& to) {
  for (std::size_t i = 0; i < places.size(); ++i) to[places[i]] = values[i];
}

std::vector<Index> merged(const std::vector<Index>& a, const std::vector<Index>& b) {
  std::vector<Index> both;
  std::merge(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
  return both;
}

std::vector<double> curvature_of(const ViewedCloud& viewed, std::span<const Index> visible,
                                 const Progress* progress) {
  if (viewed.measured.has_estimated_normals())
    return mean_curvature(viewed.cloud, viewed.spacing(), visible, {}, progress);
  std::vector<double> k = viewed.measured.curvature(*viewed.clean, visible, progress);
  for (double& each : k) each *= viewed.sign;
  return k;
}

// Finds the visible points and their curvature. Sets the surface's points, normals and colours.
Result<PointMeasures> find_points(ViewedCloud& viewed, Surface& surface, Progress* progress) {
  RELIEVO_CHECK(begin_stage(progress, "visible points", .3));
  Cloud& cloud = viewed.cloud;
  const Spacing& spacing = viewed.spacing();
  auto [visible, removed] = find_visible(cloud, spacing);
  if (removed > visible.size())
    return geometry_error(
        cat("expected points that lie close together, found ", 100 * removed / (removed + visible.size()),
            " % of those that face the viewer in small groups far from others, without which "
            "most of the figure would be missing"));
  if (visible.size() < 4) return too_few_visible(visible.size());
  surface.removed_points = removed;
  RELIEVO_CHECK(check_cancelled(progress));
  std::vector<Index> hole_fill = hole_fill_points(cloud, spacing, visible);
  surface.plane = find_support_plane(cloud, visible, surface.rho);
  if (surface.plane && !surface.view.has_plane)
    leave_out_plane(*surface.plane, spacing, cloud, {visible, hole_fill});
  surface.visible_points = visible.size();
  // Hole-fill points get level normals, because the visible surface is unknown there.
  for (const Index i : hole_fill) cloud.normals[i] = Vec3f::UnitZ();

  RELIEVO_CHECK(begin_stage(progress, "curvature", .4));
  std::vector<double> k(cloud.size(), 0.0);
  scatter(curvature_of(viewed, visible, progress), visible, k);
  RELIEVO_CHECK(check_cancelled(progress));
  // Neighbours in the view plane are to be close in memory.
  std::vector<Index> shown = merged(visible, hole_fill);
  shown = pick(shown, hilbert_order(in_plane(pick(cloud.points, shown))));
  surface.points = pick(cloud.points, shown);
  surface.normals = pick(cloud.normals, shown);
  surface.colours = pick(viewed.measured.cloud().colours, shown);
  surface.own_heights = pick(viewed.measured.cloud().own_heights, shown);
  return PointMeasures{pick(k, shown), spacing.is_uneven ? pick(spacing.local, shown) : std::vector<float>()};
}

// Triangulates the surface's points, and sets boundary.is_inside. Other functions set the rest of the boundary.
Result<void> triangulate(Surface& surface, const PointMeasures& measures, Progress* progress) {
  const std::vector<Vec2> xy = in_plane(surface.points);
  surface.triangulation = delaunay(xy);
  if (surface.triangulation.triangles.empty()) return no_area_error();
  surface.boundary = {inside_triangles(xy, surface.triangulation, surface.rho, measures.spacing), {}, {}, {}};
  return check_cancelled(progress);
}

void complete(Boundary& boundary, std::span<const Vec2> points, const Triangulation& mesh) {
  if (!boundary.is_boundary.empty()) return;
  boundary.is_boundary = boundary_points(points.size(), mesh, boundary.is_inside);
  boundary.distance = distances_to(points, boundary.is_boundary);
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

namespace {

// A surface with points, but without triangles yet, and the measures and outlines from which its triangles are found.
struct FoundPoints {
  Surface surface;
  PointMeasures measures;
  std::vector<OutlineSegment> outlines;
};

// Turns the cloud into the view and finds the visible points. These stages need the whole cloud.
Result<FoundPoints> find_points_in_view(const MeasuredCloud& measured, const View& view, Progress* progress) {
  Surface surface = surface_of_view(measured, view);
  ViewedCloud viewed = look_at(measured, surface, progress);
  RELIEVO_CHECK(check_cancelled(progress));
  RELIEVO_CHECK(check_side(viewed, view));
  RELIEVO_TRY(PointMeasures measures, find_points(viewed, surface, progress));
  return FoundPoints{std::move(surface), std::move(measures), std::move(viewed.cloud.outlines)};
}

// Finds the triangulation and the boundary, and normalises the curvature.
Result<Surface> connect_points(FoundPoints found, Progress* progress) {
  auto& [surface, measures, outlines] = found;
  RELIEVO_CHECK(begin_stage(progress, "triangulation", .6));
  RELIEVO_CHECK(triangulate(surface, measures, progress));
  RELIEVO_CHECK(begin_stage(progress, "boundary", .65));
  if (drop_small_patches(surface, measures)) RELIEVO_CHECK(triangulate(surface, measures, progress));
  // The points of a picture are its pixels. All of them are kept, also those on its outline.
  if (!is_flat_picture(surface)) put_points_on_outlines(surface, measures, outlines);
  RELIEVO_CHECK(check_cancelled(progress));
  const std::vector<Vec2> xy = in_plane(surface.points);
  complete(surface.boundary, xy, surface.triangulation);
  surface.curvature =
      normalise(average_in_plane(measures.k, xy, surface.normals, surface.triangulation, surface.rho));
  // The neighbours take as much memory as the triangles, and only the boundary needed them.
  surface.triangulation.neighbours = std::vector<Triangle>();
  return std::move(surface);
}

}  // namespace

Result<Surface> find_surface(const Cloud& cloud, const View& view, Progress* progress) {
  RELIEVO_TRY(auto measured, MeasuredCloud::measure(cloud, view, progress));
  return find_surface(std::move(measured), view, progress);
}

Result<Surface> find_surface(const MeasuredCloud& measured, const View& view, Progress* progress) {
  const std::shared_ptr<const MeasuredCloud> not_owned(std::shared_ptr<void>(), &measured);
  return find_surface(not_owned, view, progress);
}

Result<Surface> find_surface(std::shared_ptr<const MeasuredCloud> measured, const View& view,
                             Progress* progress) {
  RELIEVO_TRY(FoundPoints found, find_points_in_view(*measured, view, progress));
  measured.reset();  // frees the memory before the next stages
  return connect_points(std::move(found), progress);
}

}  // namespace relievo
