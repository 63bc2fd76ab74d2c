#include "relievo/picture/render.h"

#include <algorithm>
#include <cmath>

#include "picture/draw_body.h"
#include "picture/plate_mesh.h"

namespace relievo {
namespace {

// The longer side, in pixels, of the height field from which profiles are read. Displays show fewer pixels.
constexpr int profile_px = 1400;

std::vector<float> depths_of(const Surface& surface) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const Vec3& p : surface.points) lowest = std::min(lowest, p.z());
  std::vector<float> depths;
  for (const Vec3& p : surface.points) depths.push_back(static_cast<float>(p.z() - lowest));
  return depths;
}

}  // namespace

struct FrameRenderer::State {
  std::shared_ptr<const ReliefModel> model;
  PlateMesh mesh{plate_mesh(model->surface())};
  std::vector<float> depths{depths_of(model->surface())};  // depths of the model itself
  float deepest = std::ranges::max(depths);
  DrawCache cache = {};
  CachedVisibility profile = {};
};

FrameRenderer::FrameRenderer(std::shared_ptr<const ReliefModel> model)
    : state_(std::make_unique<State>(std::move(model))) {}
FrameRenderer::FrameRenderer(FrameRenderer&&) noexcept = default;
FrameRenderer::~FrameRenderer() = default;

Shown FrameRenderer::original() const {
  return {state_->depths, state_->model->surface().normals, 1, {{0, state_->deepest}}};
}

void FrameRenderer::render(const Shown& shown, const RenderOptions& options, Picture& picture,
                           const Progress* progress) {
  if (!options.has_size()) {
    picture = {};
    return;
  }
  const DrawnBody body = frame_body(state_->mesh, shown, options);
  const ScreenTransform transform = frame_transform(state_->mesh, options);
  picture.pixels_per_mm = transform.pixels_per_mm;
  DrawParams params{options.material, options.light, options.has_shadows, options.is_fine};
  params.progress = progress;
  draw_body(body, transform, params, state_->cache, picture.image);
}

std::vector<float> FrameRenderer::profile(const Shown& shown, const RenderOptions& options, const Vec2& from,
                                          const Vec2& to, std::size_t samples) {
  const DrawnBody body = frame_body(state_->mesh, shown, options);
  const HeightField field = front_heights(body, profile_px, state_->profile);
  std::vector<float> heights(samples);
  for (std::size_t i = 0; i < samples; ++i) {
    const double t = samples > 1 ? static_cast<double>(i) / static_cast<double>(samples - 1) : 0;
    const Vec2 place = from + t * (to - from), pixel = field.to_pixels({place.x(), place.y(), 0});
    const int x = static_cast<int>(std::floor(pixel.x())), y = static_cast<int>(std::floor(pixel.y()));
    if (field.z.contains(x, y)) heights[i] = field.z.at(x, y) + body.lowest_mm();
  }
  return heights;
}

}  // namespace relievo
