#include "picture/plate_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>

namespace relievo {
namespace {

constexpr double frame_padding =
    .055;  // space for the shadow around the plate, as a share of the picture's shorter side

// The plate's triangles are computed only once, for a relief of this width. Options move only the plate's corners.
constexpr double width_mm = 100;

Vec2 half_plate(const PlateMesh& mesh, const RenderOptions& options) {
  return options.mm_per_unit * mesh.half + Vec2::Constant(options.margin_mm);
}

}  // namespace

Mat3 rotation_of(const Camera& camera) {
  const double degree = std::numbers::pi / 180;
  return (Eigen::AngleAxisd(camera.pitch_deg * degree, Vec3::UnitX()) *
          Eigen::AngleAxisd(camera.yaw_deg * degree, Vec3::UnitY()))
      .matrix();
}

PlateParts parts_of_frames(const Solid& level, const Surface& surface) {
  PlateParts parts = plate_parts(level);
  // The edge between a thin triangle on the hull and a triangle of the ground may have been flipped. Then the
  // thin triangle has a corner of the plate as one of its corners.
  const auto is_of_points = [&](const Triangle& t) { return std::ranges::max(t) < surface.points.size(); };
  for (std::size_t t = 0; t < surface.boundary.is_inside.size(); ++t)
    if (surface.boundary.is_inside[t] && is_of_points(level.triangles[t])) parts.parts[t] = Part::relief;
  return parts;
}

PlateMesh plate_mesh(const Surface& surface) {
  PlateMesh mesh;
  const Box box = Box::of(surface.points);
  mesh.half = box.size().head<2>() / 2;
  mesh.middle = box.centre().head<2>().cast<float>();
  HeightFieldMesh front{std::vector<Vec3>(surface.points.size()), surface.triangulation.triangles,
                        surface.triangulation.hull};
  const double to_mm = width_mm / box.size().head<2>().maxCoeff();
  for (std::size_t i = 0; i < surface.points.size(); ++i) {
    mesh.places.push_back((surface.points[i] - box.centre()).head<2>());
    front.points[i] << to_mm * mesh.places.back(), 0;
  }
  Result<Solid> solid = make_plate(front, {});
  if (!solid) return mesh;
  mesh.parts = parts_of_frames(*solid, surface);
  mesh.triangles = std::move(solid->triangles);
  return mesh;
}

DrawnBody frame_body(const PlateMesh& mesh, const Shown& shown, const RenderOptions& options) {
  const float scale = static_cast<float>(options.mm_per_unit) * shown.stretch;
  DrawnBody body{mesh.triangles, mesh.parts, mesh.places,   options.mm_per_unit,
                 shown.heights,  scale,      shown.normals, shown.stretch};
  body.is_height_field = body.is_rectangle = true;
  body.detail = shown.detail;
  body.gains = shown.gains;
  body.tint = shown.tint;
  body.middle = mesh.middle;
  const auto search = [&]() -> std::array<float, 2> {
    const auto [low, high] = std::ranges::minmax(shown.heights);
    return {low, high};
  };
  const auto [lowest, highest] = shown.range ? *shown.range : search();
  const Vec2 half = half_plate(mesh, options);
  body.front.extend({-half.x(), -half.y(), static_cast<double>(scale * std::min(0.F, lowest))});
  body.front.extend({half.x(), half.y(), static_cast<double>(scale * std::max(0.F, highest))});
  const double bottom = body.front.min.z() - options.thickness_mm;
  for (int i = 0; i < 8; ++i) {  // corners are in the same order as in make_plate()
    const double x = i % 4 == 1 || i % 4 == 2 ? half.x() : -half.x(), y = i % 4 >= 2 ? half.y() : -half.y();
    body.box_corners.push_back({x, y, i < 4 ? 0 : bottom});
  }
  return body;
}

// An orbiting camera keeps the scale of the front view as long as the plate's corners stay in the picture. The corners
// may come closer to the picture's edge than in the front view, which needs space for the plate's shadow.
ScreenTransform camera_transform(const Vec3& size, const RenderOptions& options) {
  constexpr double least_padding = .03;
  const double side = std::min(options.width, options.height);
  const Camera& camera = options.camera;
  const Mat3 rotation = rotation_of(camera);
  const Vec3 seen = rotation.cwiseAbs() * size;
  const auto fit_of = [&](const Vec3& box, double padding) {
    const double pad = 2 * padding * side;
    return std::min((options.width - pad) / box.x(), (options.height - pad) / box.y());
  };
  const double fit = std::min(fit_of(size, frame_padding), fit_of(seen, least_padding));
  ScreenTransform transform{options.width, options.height, std::max(fit, 1e-3) * camera.zoom, rotation};
  transform.pan << camera.pan, 0;
  transform.is_front = camera.yaw_deg == 0 && camera.pitch_deg == 0;
  return transform;
}

ScreenTransform frame_transform(const PlateMesh& mesh, const RenderOptions& options) {
  const Vec2 size = 2 * half_plate(mesh, options);
  return camera_transform({size.x(), size.y(), 2 * options.thickness_mm}, options);
}

}  // namespace relievo
