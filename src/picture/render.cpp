#include "relievo/picture/render.h"

#include <cmath>

#include "picture/draw_body.h"
#include "picture/live_plate.h"
#include "picture/plate_mesh.h"
#include "picture/shading.h"
#include "relievo/core/parallel.h"
#include "relievo/scan/normals.h"
#include "relievo/scan/spacing.h"

namespace relievo {
namespace {

// The longer side, in pixels, of the height field from which profiles are taken. Pictures of profiles have
// fewer pixels than this.
constexpr int profile_px = 1400;

std::vector<float> depths_of(const Surface& surface) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const Vec3& p : surface.points) lowest = std::min(lowest, p.z());
  std::vector<float> depths;
  for (const Vec3& p : surface.points) depths.push_back(static_cast<float>(p.z() - lowest));
  return depths;
}

constexpr float nothing = -std::numeric_limits<float>::infinity();

// The direction to the lamp that lights scans. It is closer to the viewer's direction than that of the lamp
// that lights reliefs, because large parts of a whole body would face away from the latter.
const Vec3f scan_lamp(-1, 1, 1.4F);

// Radius of a point's disc, in sampling distances. With this radius, randomly scattered points leave few
// gaps.
constexpr double disc_radius = 1.7;

// A point of the scan in the picture: position and depth in pixels, normal in view coordinates.
struct Dot {
  Vec3f place, normal;
};

struct Canvas {
  Image<float> depth;
  Image<Vec3f> normals;  // weighted sums
};

// Calls f(pixel, depth, weight) for the pixels of rows [first, last) whose centres the dot covers. The dot
// is drawn as a disc in the surface; `depth` is the disc's depth at the pixel. The weight falls from 1 at
// the disc's centre to 0 at its edge.
template <typename F>
void each_pixel(const Dot& dot, float radius, int width, int first, int last, F&& f) {
  constexpr float least_z = .2F;  // limits the tilt, because tilted discs leave gaps
  const Vec2f slope = Vec2f(-dot.normal.x(), dot.normal.y()) / std::max(dot.normal.z(), least_z);
  const float per_square = 1 / (radius * radius);
  const int top = std::max(first, static_cast<int>(std::floor(dot.place.y() - radius + .5F)));
  const int bottom = std::min(last, static_cast<int>(std::floor(dot.place.y() + radius + .5F)));
  const int left = std::max(0, static_cast<int>(std::floor(dot.place.x() - radius + .5F)));
  const int right = std::min(width, static_cast<int>(std::floor(dot.place.x() + radius + .5F)));
  for (int y = top; y < bottom; ++y)
    for (int x = left; x < right; ++x) {
      const Vec2f away(static_cast<float>(x) + .5F - dot.place.x(),
                       static_cast<float>(y) + .5F - dot.place.y());
      const float rise = slope.dot(away), weight = 1 - per_square * (away.squaredNorm() + rise * rise);
      if (weight > 0)
        f(static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x),
          dot.place.z() + rise, weight);
    }
}

// Draws the dots in two passes (surface splatting). The first pass finds the front-most depth of each pixel.
// The second pass computes the mean normal of the dots near this depth.
void splat(const std::vector<Dot>& dots, float radius, Canvas& canvas) {
  const int rows = 32, width = canvas.depth.width, height = canvas.depth.height;
  const auto band = [&](std::size_t b) {
    const int first = static_cast<int>(b) * rows, last = std::min(height, first + rows);
    const float above = static_cast<float>(first) - radius - 1, below = static_cast<float>(last) + radius + 1;
    std::vector<const Dot*> near;
    for (const Dot& dot : dots)
      if (dot.normal.z() > 0 && dot.place.y() > above && dot.place.y() < below) near.push_back(&dot);
    for (const Dot* dot : near)
      each_pixel(*dot, radius, width, first, last, [&](std::size_t at, float z, float) {
        canvas.depth.pixels[at] = std::max(canvas.depth.pixels[at], z);
      });
    for (const Dot* dot : near)
      each_pixel(*dot, radius, width, first, last, [&](std::size_t at, float z, float weight) {
        if (z > canvas.depth.pixels[at] - 2.5F * radius) canvas.normals.pixels[at] += weight * dot->normal;
      });
  };
  parallel_for(static_cast<std::size_t>((height + rows - 1) / rows), band, 1);
}

void paint(const Canvas& canvas, Image8& picture) {
  const Shader shader(Material::plaster, direction_of(scan_lamp), Vec3f::UnitZ());
  const DisplayTable& display = display_table();
  parallel_for(canvas.depth.pixels.size(), [&](std::size_t i) {
    std::uint8_t* const rgba = picture.pixels.data() + 4 * i;
    if (canvas.depth.pixels[i] == nothing) {
      std::fill_n(rgba, 4, std::uint8_t{0});
      return;
    }
    const Vec3f colour = shader.colour({canvas.normals.pixels[i].normalized(), {1, 1}, Vec3f::Zero(), 0});
    for (int c = 0; c < 3; ++c) rgba[c] = display(colour[c]);
    rgba[3] = 255;
  });
}

}  // namespace

struct FrameRenderer::State {
  std::shared_ptr<const Surface> surface;
  PlateMesh mesh{plate_mesh(*surface)};
  std::vector<float> depths{depths_of(*surface)};  // depths of the model without compression
  float deepest = std::ranges::max(depths);
  DrawCache cache = {};
  CachedVisibility profile = {};
  std::optional<LivePlate> plate = {};  // the plate of the last render_on()
};

FrameRenderer::FrameRenderer(std::shared_ptr<const Surface> surface)
    : state_(std::make_unique<State>(std::move(surface))) {}
FrameRenderer::FrameRenderer(const std::shared_ptr<const ReliefModel>& model)
    : FrameRenderer(std::shared_ptr<const Surface>(model, &model->surface())) {}
FrameRenderer::FrameRenderer(FrameRenderer&&) noexcept = default;
FrameRenderer::~FrameRenderer() = default;

Shown FrameRenderer::original() const {
  return {state_->depths, state_->surface->normals, 1, {{0, state_->deepest}}};
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

Result<PlacedRelief> FrameRenderer::render_on(const PlateOptions& plate, const Shown& shown,
                                              const RenderOptions& options, Picture& picture,
                                              const Progress* progress) {
  std::optional<LivePlate>& live = state_->plate;
  if (!live || !live->serves(plate, options.mm_per_unit, options.is_fine)) {
    live.reset();
    RELIEVO_TRY(live, LivePlate::make(*state_->surface, plate, options.mm_per_unit));
  }
  RELIEVO_TRY(const DrawnBody body, live->body(shown, plate.rim.height_mm));
  if (!options.has_size()) return picture = {}, live->placed();
  const ScreenTransform transform = camera_transform(live->size_around_ground(), options);
  picture.pixels_per_mm = transform.pixels_per_mm;
  DrawParams params{options.material, options.light, options.has_shadows, options.is_fine};
  params.progress = progress;
  draw_body(body, transform, params, live->cache, picture.image);
  return live->placed();
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

CloudRenderer::CloudRenderer(const Cloud& cloud) {
  constexpr std::size_t most_points = 250'000;
  const std::size_t step = std::max<std::size_t>(1, (cloud.size() + most_points - 1) / most_points);
  for (std::size_t i = 0; i < cloud.size(); i += step) {
    cloud_.points.push_back(cloud.points[i]);
    if (cloud.has_normals()) cloud_.normals.push_back(cloud.normals[i]);
  }
  if (cloud_.points.empty()) return;
  const Box box = bounds(cloud_);
  centre_ = box.centre();
  radius_ = std::max(box.diagonal() / 2, 1e-300);
  has_signed_normals_ = cloud.has_normals();
  if (!has_signed_normals_) estimate_normals(cloud_);
  if (has_signed_normals_ && normals_point_inward(cloud_)) flip_normals(cloud_);
  cloud_.normals.resize(cloud_.size(), Vec3f::UnitZ());
  spacing_ = measure_spacing(without_repeated_points(cloud_)).rho;
}

void CloudRenderer::render(const View& view, int width, int height, Picture& picture) const {
  picture = {};
  if (width < 1 || height < 1 || std::max(width, height) > 8192 || cloud_.points.empty()) return;
  const double scale = .47 * std::min(width, height) / radius_;
  picture.pixels_per_mm = scale;
  picture.image.resize(width, height, 4);
  Canvas canvas{filled_image(width, height, nothing), filled_image(width, height, Vec3f(Vec3f::Zero()))};

  std::vector<Dot> dots(cloud_.size());
  const Eigen::Matrix3f turn = view.R_view_model.cast<float>();
  parallel_for(dots.size(), [&](std::size_t i) {
    const Vec3 p = scale * (view.R_view_model * (cloud_.points[i] - centre_));
    Vec3f normal = turn * cloud_.normals[i];
    if (!has_signed_normals_ && normal.z() < 0) normal = -normal;
    dots[i] = {Vec3(width / 2.0 + p.x(), height / 2.0 - p.y(), p.z()).cast<float>(), normal};
  });
  splat(dots, std::clamp(static_cast<float>(disc_radius * scale * spacing_), .8F, 20.F), canvas);
  paint(canvas, picture.image);
}

}  // namespace relievo
