#include "picture/body.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "geometry/weld.h"
#include "relievo/core/parallel.h"
#include "relievo/scan/mesh.h"

namespace relievo {
namespace {

// At edges of a plate, normals differ by more than this angle; between the facets of round parts they differ by less.
constexpr double sharpest_deg = 20;

// Tolerance for the heights of points on the ground. These heights differ slightly, because solids are
// rounded to single precision.
constexpr double rounding_mm = 1e-6;

bool is_at_ground(const Solid& solid, const Triangle& corners) {
  return std::ranges::all_of(
      corners, [&](Index i) { return std::abs(solid.points[i].z() - solid.ground_mm) < rounding_mm; });
}

bool is_level(const Solid& solid, const Triangle& corners) {
  const double z = solid.points[corners[0]].z();
  return solid.points[corners[1]].z() == z && solid.points[corners[2]].z() == z;
}

Region region_of(const Solid& solid, std::size_t t) {
  return solid.regions.empty() ? Region::relief : solid.regions[t];
}

Part part_of(const Solid& solid, std::size_t t) {
  if (t >= solid.front_triangles) return Part::wall;
  switch (region_of(solid, t)) {
    case Region::relief:
      return Part::relief;
    case Region::ground:
      if (is_at_ground(solid, solid.triangles[t])) return Part::ground;
      return is_level(solid, solid.triangles[t]) ? Part::relief : Part::curved;
    default:
      return Part::curved;
  }
}

}  // namespace

// The ground and the rim's bevel are smoothed separately, so that their common edge stays sharp even at a small angle.
PlateParts plate_parts(const Solid& solid) {
  const std::size_t count = solid.triangles.size();
  PlateParts out{std::vector<Part>(count), std::vector<Index>(count, no_index), {}, solid.front_triangles};
  parallel_for(count, [&](std::size_t t) { out.parts[t] = part_of(solid, t); });
  const auto add = [&](auto&& is_member) {
    Mesh members{solid.points, {}};
    const std::size_t begin = out.corner_normals.size();
    for (std::size_t t = 0; t < count; ++t) {
      if (!is_member(t)) continue;
      out.corners_at[t] = static_cast<Index>(begin + members.triangles.size());
      members.triangles.push_back(solid.triangles[t]);
    }
    const auto smooth = smooth_normals(members, sharpest_deg);
    out.corner_normals.insert(out.corner_normals.end(), smooth.begin(), smooth.end());
  };
  const auto is_curved = [&](std::size_t t, Region region) {
    return out.parts[t] == Part::curved && region_of(solid, t) == region;
  };
  for (std::size_t t = 0; t < count && !out.has_curved_ground; ++t)
    out.has_curved_ground = is_curved(t, Region::ground);
  add([&](std::size_t t) { return is_curved(t, Region::ground); });
  add([&](std::size_t t) { return is_curved(t, Region::bevel); });
  add([&](std::size_t t) { return out.parts[t] == Part::wall; });
  return out;
}

// Only triangles of the region `relief` count. The triangles of the ground are large and thin, and would
// spread the shading of the relief's rim across the ground.
std::vector<Vec3f> relief_normals(const Solid& solid) {
  std::vector<Vec3f> normals(solid.points.size(), Vec3f::Zero());
  for (std::size_t t = 0; t < solid.front_triangles; ++t) {
    if (region_of(solid, t) != Region::relief) continue;
    const Triangle& corners = solid.triangles[t];
    const Vec3 p = solid.points[corners[1]] - solid.points[corners[0]],
               q = solid.points[corners[2]] - solid.points[corners[0]];
    const Vec3f twice_area = p.cross(q).cast<float>();
    for (const Index i : corners) normals[i] += twice_area;
  }
  parallel_for(normals.size(), [&](std::size_t i) { normals[i].normalize(); });
  return normals;
}

SolidBody::SolidBody(const Solid& solid)
    : solid_(solid),
      parts_(plate_parts(solid)),
      places_(solid.points.size()),
      heights_(solid.points.size()),
      normals_(relief_normals(solid)) {
  const Vec2 middle = used_box(solid.points, solid.triangles).centre().head<2>();
  parallel_for(places_.size(), [&](std::size_t i) {
    places_[i] = solid.points[i].head<2>() - middle;
    heights_[i] = static_cast<float>(solid.points[i].z() - solid.ground_mm);
  });
}

DrawnBody SolidBody::body() const {
  DrawnBody body{solid_.triangles, parts_, places_, 1, heights_, 1, normals_};
  for (std::size_t t = 0; t < parts_.front_triangles; ++t)
    for (const Index i : solid_.triangles[t]) body.front.extend(body.point(i));
  return body;
}

}  // namespace relievo
