#include "paper/surface.h"

#include "core/lists.h"
#include "geometry/hilbert.h"
#include "geometry/plane.h"
#include "paper/curvature.h"
#include "paper/visible_points.h"
#include "scan/measured_cloud.h"

namespace relievo::paper {
namespace {

constexpr double largest_radius = 3;  // in rho: largest radius of a triangle's empty circle inside the relief

Boundary boundary_of(std::span<const Vec2> points, const Triangulation& mesh, double rho) {
  Boundary boundary;
  for (const auto& [a, b, c] : mesh.triangles)
    boundary.is_inside.push_back(circumradius(points[a], points[b], points[c]) <= largest_radius * rho);
  boundary.is_boundary = boundary_points(points.size(), mesh, boundary.is_inside);
  boundary.distance = distances_to(points, boundary.is_boundary);
  return boundary;
}

}  // namespace

Result<Surface> find_surface(const MeasuredCloud& measured, const View& view, Progress* progress) {
  Surface surface = surface_of_view(measured, view);
  const ViewedCloud viewed = look_at(measured, surface, progress);
  RELIEVO_CHECK(check_cancelled(progress));
  RELIEVO_CHECK(check_side(viewed, view));

  RELIEVO_CHECK(begin_stage(progress, "visible points", .1));
  std::vector<Index> visible = visible_points(viewed.cloud, surface.rho);
  if (visible.size() < 4) return too_few_visible(visible.size());
  visible = pick(visible, hilbert_order(in_plane(pick(viewed.cloud.points, visible))));
  surface.visible_points = visible.size();
  surface.points = pick(viewed.cloud.points, visible);
  surface.normals = pick(viewed.cloud.normals, visible);
  surface.colours = pick(measured.cloud().colours, visible);

  RELIEVO_CHECK(begin_stage(progress, "curvature", .2));
  surface.curvature = normalise(mean_curvature(viewed.cloud, surface.rho, visible, progress));
  RELIEVO_CHECK(begin_stage(progress, "triangulation", .6));
  const std::vector<Vec2> points = in_plane(surface.points);
  surface.triangulation = delaunay(points);
  if (surface.triangulation.triangles.empty()) return no_area_error();
  surface.boundary = boundary_of(points, surface.triangulation, surface.rho);
  surface.triangulation.neighbours = std::vector<Triangle>();
  RELIEVO_CHECK(check_cancelled(progress));
  return surface;
}

}  // namespace relievo::paper
