#include "scan/front_mesh.h"

#include <algorithm>

#include "relievo/scan/visible.h"
#include "scan/depth_buffer.h"
#include "scan/jumps.h"

namespace relievo {
namespace {

// Returns a surface with only the members that is_jump() reads.
Surface surface_of(const Cloud& viewed, const Spacing& spacing) {
  Surface surface;
  surface.rho = spacing.rho;
  for (const Index i : visible_points(viewed, spacing)) {
    surface.points.push_back(viewed.points[i]);
    surface.normals.push_back(viewed.normals[i]);
    if (viewed.has_colours()) surface.colours.push_back(viewed.colours[i]);
    if (!viewed.own_heights.empty()) surface.own_heights.push_back(viewed.own_heights[i]);
  }
  const std::vector<Vec2> xy = in_plane(surface.points);
  surface.triangulation = delaunay(xy);
  surface.boundary = find_boundary(xy, surface.triangulation, surface.rho);
  return surface;
}

// Returns whether a triangle is wider than the gaps between neighbouring points of one surface.
bool is_wide(const Surface& surface, const Triangle& t) {
  constexpr double widest_gap = 2.5;  // in rho; in random scans hardly any Delaunay edge is longer
  double longest = 0;
  for (std::size_t i = 0; i < 3; ++i)
    longest = std::max(longest, (surface.points[t[i]] - surface.points[t[(i + 1) % 3]]).head<2>().norm());
  return longest > widest_gap * surface.rho;
}

// Returns whether one surface may connect the corners of a triangle: no two of their normals differ by more
// than 60 degrees. Within 2.5 rho, normals rarely differ that much except across an edge of the model.
bool look_alike(const Surface& surface, const Triangle& t) {
  const auto& n = surface.normals;
  constexpr float least_cosine = .5F;  // cosine of 60 degrees
  return std::min({n[t[0]].dot(n[t[1]]), n[t[1]].dot(n[t[2]]), n[t[2]].dot(n[t[0]])}) > least_cosine;
}

class Mesher {
 public:
  explicit Mesher(const Surface& surface) : surface_(surface) {
    mesh_.points = surface.points;
    mesh_.colours = surface.colours;
    mesh_.own_heights = surface.own_heights;
  }

  Mesh make() {
    const std::vector<std::uint8_t> is_jumping = jump_triangles(surface_);
    for (std::size_t t = 0; t < is_jumping.size(); ++t) {
      const Triangle& corners = surface_.triangulation.triangles[t];
      const auto& [a, b, c] = corners;
      if (!surface_.boundary.is_inside[t]) continue;
      if (is_wide(surface_, corners) && (is_jumping[t] || !look_alike(surface_, corners)))
        add(corners, {Vec3f::UnitZ(), Vec3f::UnitZ(), Vec3f::UnitZ()});
      else if (is_jumping[t])
        share_out(corners);
      else
        add(corners, {surface_.normals[a], surface_.normals[b], surface_.normals[c]});
    }
    return std::move(mesh_);
  }

 private:
  void add(const Triangle& t, const std::array<Vec3f, 3>& normals) {
    mesh_.triangles.push_back(t);
    mesh_.corner_normals.push_back(normals);
  }

  // Divides a triangle among its corners by lines from its centre to the midpoints of its sides.
  void share_out(const Triangle& t) {
    const auto at = [&](std::size_t i) -> Vec2 { return surface_.points[t[i % 3]].head<2>(); };
    const Vec2 centre = (at(0) + at(1) + at(2)) / 3;
    for (std::size_t i = 0; i < 3; ++i) {
      const Index next = add_point(t[i], (at(i) + at(i + 1)) / 2), middle = add_point(t[i], centre);
      const Index last = add_point(t[i], (at(i) + at(i + 2)) / 2);
      const Vec3f& normal = surface_.normals[t[i]];
      add({t[i], next, middle}, {normal, normal, normal});
      add({t[i], middle, last}, {normal, normal, normal});
    }
  }

  // Adds a point in the tangent plane of a corner. Returns its index.
  Index add_point(Index corner, const Vec2& place) {
    const Vec3& from = surface_.points[corner];
    const Vec2 step = place - from.head<2>();
    const double z = from.z() + depth_along_plane(surface_.normals[corner], step.x(), step.y());
    mesh_.points.emplace_back(place.x(), place.y(), z);
    if (!mesh_.colours.empty()) mesh_.colours.push_back(surface_.colours[corner]);
    if (!mesh_.own_heights.empty()) mesh_.own_heights.push_back(surface_.own_heights[corner]);
    return static_cast<Index>(mesh_.points.size() - 1);
  }

  const Surface& surface_;
  Mesh mesh_;
};

}  // namespace

Mesh front_mesh(const Cloud& viewed, const Spacing& spacing) {
  const Surface surface = surface_of(viewed, spacing);
  return Mesher(surface).make();
}

}  // namespace relievo
