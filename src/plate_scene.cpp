#include "plate_scene.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "relievo/core/parallel.h"
#include "relievo/plate/solid.h"

namespace relievo {
namespace {

constexpr double padding = .055;  // around the plate, as a share of the picture's shorter side

Mat3 turn_of(const Camera& camera) {
  const double degree = std::numbers::pi / 180;
  return (Eigen::AngleAxisd(camera.pitch_deg * degree, Vec3::UnitX()) *
          Eigen::AngleAxisd(camera.yaw_deg * degree, Vec3::UnitY()))
      .matrix();
}

Vec2 half_plate(const Topology& topology, const RenderOptions& options) {
  return options.mm_per_unit * topology.half + Vec2::Constant(options.margin_mm);
}

}  // namespace

Topology topology_of(const Surface& surface) {
  Topology topology;
  Box box;
  for (const Vec3& p : surface.points) box.extend(p);
  topology.half = box.size().head<2>() / 2;
  Front front{std::vector<Vec3>(surface.points.size()), surface.triangulation.triangles,
              surface.triangulation.hull};
  const double to_mm = 100 / box.size().head<2>().maxCoeff();
  for (std::size_t i = 0; i < surface.points.size(); ++i) {
    topology.places.push_back((surface.points[i] - box.centre()).head<2>());
    front.points[i] << to_mm * topology.places.back(), 0;
  }
  Result<Solid> solid = make_plate(front, {});
  if (!solid) return topology;
  for (std::size_t t = 0; t < solid->triangles.size(); ++t) {
    const bool is_relief = t < surface.boundary.is_inside.size() && surface.boundary.is_inside[t];
    topology.parts.push_back(is_relief                    ? Part::relief
                             : t < solid->front_triangles ? Part::ground
                                                          : Part::wall);
  }
  topology.triangles = std::move(solid->triangles);
  return topology;
}

PlateScene scene_of(const Topology& topology, const Shown& shown, const RenderOptions& options) {
  const auto [lowest, highest] = std::ranges::minmax(shown.heights);
  const float scale = static_cast<float>(options.mm_per_unit) * shown.stretch;
  const float low = std::min(0.F, lowest) * scale, high = std::max(0.F, highest) * scale;
  return {topology, shown, options, scale, low, high - low};
}

Placement placement_of(const Topology& topology, const RenderOptions& options, int samples_per_side) {
  const Vec2 size = 2 * half_plate(topology, options);
  const double pad = 2 * padding * std::min(options.width, options.height);
  const Camera& camera = options.camera;
  const Mat3 turn = turn_of(camera);
  const Vec3 seen = turn.cwiseAbs() * Vec3(size.x(), size.y(), 2 * options.thickness_mm);
  const double fit = std::min((options.width - pad) / std::max(size.x(), seen.x()),
                              (options.height - pad) / std::max(size.y(), seen.y()));
  Placement placement{options.width * samples_per_side, options.height * samples_per_side,
                      std::max(fit, 1e-3) * camera.zoom * samples_per_side, turn};
  placement.pan << camera.pan, 0;
  placement.is_front = camera.yaw_deg == 0 && camera.pitch_deg == 0;
  return placement;
}

Drawing raster_scene(const PlateScene& scene, const Placement& placement) {
  const auto& places = scene.topology.places;
  const double scale = scene.options.mm_per_unit;
  Drawing raster;
  raster.triangles = scene.topology.triangles;
  raster.width = placement.width;
  raster.height = placement.height;
  raster.points.resize(places.size() + 8);
  parallel_for(places.size(), [&](std::size_t i) {
    const float z = placement.is_front ? 0 : scene.z_mm * scene.shown.heights[i];
    const Vec2 xy = scale * places[i];
    raster.points[i] = placement.to_picture({xy.x(), xy.y(), static_cast<double>(z)});
  });
  const Vec2 half = half_plate(scene.topology, scene.options);
  const double bottom = static_cast<double>(scene.lowest_mm) - scene.options.thickness_mm;
  for (std::size_t i = 0; i < 8; ++i) {  // in the order of make_plate()
    const double x = i % 4 == 1 || i % 4 == 2 ? half.x() : -half.x(), y = i % 4 >= 2 ? half.y() : -half.y();
    raster.points[places.size() + i] = placement.to_picture({x, y, i < 4 ? 0 : bottom});
  }
  return raster;
}

Vec3f wall_normal(const Triangle& corners, std::size_t first_corner) {
  const auto is_bottom = [&](Index i) { return i >= first_corner + 4; };
  if (is_bottom(corners[0]) && is_bottom(corners[1]) && is_bottom(corners[2])) return -Vec3f::UnitZ();
  // A wall runs between two neighbouring corners: 0-1 below, 1-2 right, 2-3 above, 3-0 left.
  bool has[4] = {};
  for (const Index i : corners) has[(i - first_corner) % 4] = true;
  if (has[0] && has[1]) return -Vec3f::UnitY();
  if (has[1] && has[2]) return Vec3f::UnitX();
  return has[2] && has[3] ? Vec3f(Vec3f::UnitY()) : Vec3f(-Vec3f::UnitX());
}

}  // namespace relievo
