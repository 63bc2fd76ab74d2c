#include "relievo/picture/preview.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "picture/draw_body.h"
#include "picture/plate_mesh.h"
#include "picture/shading.h"
#include "relievo/core/parallel.h"

namespace relievo {
namespace {

constexpr double preview_padding =
    .06;  // space for the shadow around the plate, as a share of the picture's longer side
// Each of the two pictures of a preview has 3 samples per pixel in each direction. Its longer side has at
// most this many pixels.
constexpr int most_pixels = RasterInput::most_pixels / 3 / 2;

// Linear brightness of the background, at the top and at the bottom. It contrasts with the plate, and is
// darker at the bottom, as on a wall lit from above.
constexpr float brightest_wall = .90F, darkest_wall = .70F;

// The oblique view is from above on the right, because there the upper left lamp shows slopes and the
// plate's edge best.
constexpr double oblique_yaw_deg = -35, oblique_pitch_deg = 20;

// Returns the part of a solid below `most_z`.
Solid cut_open(const Solid& solid, double most_z) {
  Solid open{solid.points, {}};
  open.ground_mm = solid.ground_mm;
  const auto is_kept = [&](Index i) { return open.points[i].z() <= most_z; };
  const auto crossing = [&](const Vec3& a, const Vec3& b) {
    const Vec3 p = a + (most_z - a.z()) / (b.z() - a.z()) * (b - a);
    open.points.push_back(p);
    return static_cast<Index>(open.points.size() - 1);
  };
  for (std::size_t t = 0; t < solid.triangles.size(); ++t) {
    std::vector<Index> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const Index a = solid.triangles[t][k], b = solid.triangles[t][(k + 1) % 3];
      if (is_kept(a)) corners.push_back(a);
      if (is_kept(a) != is_kept(b)) corners.push_back(crossing(Vec3(solid.points[a]), solid.points[b]));
    }
    for (std::size_t k = 2; k < corners.size(); ++k) {
      open.triangles.push_back({corners[0], corners[k - 1], corners[k]});
      if (t < solid.regions.size()) open.regions.push_back(solid.regions[t]);
      open.front_triangles += t < solid.front_triangles;
    }
  }
  return open;
}

Box rotated_box(const DrawnBody& body, const Mat3& rotation) {
  Box box;
  for (const Triangle& t : body.triangles)
    for (const Index i : t) box.extend(rotation * body.point(i));
  return box;
}

// Returns the transforms for two pictures of the same size; its longer side is `longer_side_px`. The first
// picture is the front view of `front_body`. The second one is the oblique view of `oblique_body`.
std::array<ScreenTransform, 2> preview_transforms(const DrawnBody& front_body, const DrawnBody& oblique_body,
                                                  int longer_side_px) {
  const Mat3 rotation = rotation_of({oblique_yaw_deg, oblique_pitch_deg});
  const Box front = rotated_box(front_body, Mat3::Identity()), side = rotated_box(oblique_body, rotation);
  const double longer = std::max(front.size().x(), front.size().y());
  const double scale = longer_side_px * (1 - 2 * preview_padding) / longer,
               pad = 2 * preview_padding * longer_side_px;
  const auto pixels = [&](double mm) { return std::max(1, static_cast<int>(std::lround(mm * scale + pad))); };
  const int width = pixels(front.size().x()), height = pixels(front.size().y());
  const double fit = std::min((width - pad) / side.size().x(), (height - pad) / side.size().y());
  const Vec3 middle = rotation.transpose() * side.centre();
  return {ScreenTransform{width, height, scale},
          ScreenTransform{width, height, std::min(scale, fit), rotation, middle, false}};
}

// Composites a transparent picture over the background, starting at column `left`.
void lay_on_wall(const Image8& picture, int left, Image8& image) {
  const DisplayTable& display = display_table();
  const auto lay_row = [&](std::size_t row) {
    const int y = static_cast<int>(row);
    const float share = static_cast<float>(y) / static_cast<float>(picture.height);
    const int wall = display(brightest_wall + (darkest_wall - brightest_wall) * share);
    const std::uint8_t* from = &picture.at(0, y);
    std::uint8_t* to = &image.at(left, y);
    for (int x = 0; x < picture.width; ++x, from += 4, to += 3)
      for (int i = 0; i < 3; ++i)
        to[i] = static_cast<std::uint8_t>((from[i] * from[3] + wall * (255 - from[3]) + 127) / 255);
  };
  parallel_for(static_cast<std::size_t>(picture.height), lay_row, 16);
}

}  // namespace

Image8 render_preview(const Solid& solid, const PreviewOptions& options) {
  if (solid.triangles.empty() || options.longer_side_px < 1 || options.longer_side_px > most_pixels)
    return {};
  std::optional<Solid> opened;
  if (std::isfinite(options.nearest_mm)) opened = cut_open(solid, options.nearest_mm);
  const SolidBody bent(opened ? *opened : solid);
  std::optional<SolidBody> flat;
  if (options.flat) flat.emplace(*options.flat);
  const std::array<DrawnBody, 2> bodies{flat ? flat->body() : bent.body(), bent.body()};
  const bool is_lit_flat = flat && options.material == Material::porcelain;
  const std::array<Material, 2> materials{options.material,
                                          is_lit_flat ? Material::plaster : options.material};
  const auto transforms = preview_transforms(bodies[0], bodies[1], options.longer_side_px);
  const int width = transforms[0].width;
  Image8 image = filled_image(2 * width, transforms[0].height, std::uint8_t{0}, 3), picture;
  std::array<DrawCache, 2> caches;
  for (std::size_t i = 0; i < 2; ++i) {
    draw_body(bodies[i], transforms[i], {materials[i], options.light, true, true}, caches[flat ? i : 0],
              picture);
    lay_on_wall(picture, static_cast<int>(i) * width, image);
  }
  return image;
}

struct SolidRenderer::State {
  std::shared_ptr<const Solid> solid;
  SolidBody owner{*solid};
  DrawnBody body{owner.body()};
  Vec3 size = size_around_ground(body);
  DrawCache cache = {};
  std::shared_ptr<const ToolReach> reach = {};

  // Returns the size of the smallest box that contains the body and is centred at the origin.
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
