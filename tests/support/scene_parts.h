// Makes the models, poses and placements that scenes in tests consist of.
#pragma once

#include "relievo/scan/scan_file.h"
#include "relievo/scene.h"
#include "support/results.h"
#include "support/shapes.h"

namespace relievo::test {

inline const View front = *parse_view("front");

inline SceneModel model_of(Cloud cloud, Pose pose = {}) {
  return {"cloud", std::make_shared<const CloudFile>(CloudFile{std::move(cloud), "test"}), pose};
}

inline SceneModel model_of(Mesh mesh, Pose pose = {}) {
  CloudFile file{{mesh.points, {}}, "test"};
  file.mesh = std::move(mesh);
  return {"mesh", std::make_shared<const CloudFile>(std::move(file)), pose};
}

inline Pose at(double x, double y, double z, const Vec3& rotate_deg = Vec3::Zero()) {
  return {rotate_deg, Vec3(x, y, z)};
}

// Returns a wedge that no rotation or reflection maps onto itself, so that tests notice a wrong rotation or
// reflection.
inline Mesh wedge() {
  return {{{0, 0, 0}, {3, 0, 0}, {0, 2, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

inline std::vector<PlacedModel> placed(const Scene& scene, const View& view = front) {
  return value_of(place_models(scene, view));
}

inline ViewSample seen(const Scene& scene, double points = 30000, const View& view = front) {
  return value_of(sample_for_view(scene, view, points));
}

}  // namespace relievo::test
