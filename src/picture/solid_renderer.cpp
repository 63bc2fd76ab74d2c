// Tested by tests/picture/one_renderer_test.cpp.
#include "relievo/picture/solid_renderer.h"

#include <algorithm>

#include "picture/draw_body.h"
#include "picture/plate_mesh.h"

namespace relievo {

struct SolidRenderer::State {
  std::shared_ptr<const Solid> solid;
  SolidBody owner{*solid};
  DrawnBody body{owner.body()};
  Vec3 size = size_around_ground(body);
  DrawCache cache = {};
  std::shared_ptr<const ToolReach> reach = {};

  // Returns the size of the box around the origin that contains the body.
  static Vec3 size_around_ground(const DrawnBody& body) {
    Vec3 half = Vec3::Zero();
    for (const Triangle& t : body.triangles)
      for (const Index i : t) half = half.cwiseMax(body.point(i).cwiseAbs());
    return 2 * half;
  }
};

SolidRenderer::SolidRenderer(std::shared_ptr<const Solid> solid)
    : state_(std::make_unique<State>(std::move(solid))) {}
SolidRenderer::SolidRenderer(std::shared_ptr<const Solid> solid, std::shared_ptr<const ToolReach> reach)
    : SolidRenderer(std::move(solid)) {
  state_->reach = std::move(reach);
}
SolidRenderer::SolidRenderer(SolidRenderer&&) noexcept = default;
SolidRenderer::~SolidRenderer() = default;

void SolidRenderer::render(const RenderOptions& options, Picture& picture, const Progress* progress) {
  if (!options.has_size()) {
    picture = {};
    return;
  }
  const ScreenTransform transform = camera_transform(state_->size, options);
  picture.pixels_per_mm = transform.pixels_per_mm;
  draw_body(state_->body, transform,
            {options.material, options.light, options.has_shadows, options.is_fine, state_->reach, progress},
            state_->cache, picture.image);
}

}  // namespace relievo
