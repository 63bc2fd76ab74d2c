#include "relievo/picture/render.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "blur.h"
#include "picture/shading.h"
#include "plate_scene.h"
#include "relievo/core/parallel.h"

namespace relievo {
namespace {

constexpr int largest_side = 8192;
constexpr double light_margin = .06;  // of the map of light around the relief, as a share of its longer side
// ---------------------------------------------------------------------------------------------------- pixels

struct Colour {
  Vec3f rgb = Vec3f::Zero();
  float coverage = 0;
};

class Painter {
 public:
  Painter(const PlateScene& scene, const Placement& placement, const LightMap& light)
      : scene_(scene),
        placement_(placement),
        light_(light),
        shader_(scene.options.material, scene.options.light.normalized(),
                placement.turn.row(2).transpose().cast<float>()) {}

  Colour at(const Pixel& pixel, int column, int row) const {
    if (pixel.part == Part::nothing) return {};
    Lit lit{Vec3f::UnitZ(), {1, 1}, placement_.to_place(column + .5, row + .5, static_cast<double>(pixel.z))};
    if (pixel.part == Part::relief) {
      lit.normal = pixel.mean(scene_.shown.normals.data());
      lit.normal.head<2>() *= scene_.shown.stretch;
      lit.normal.normalize();
      lit.place.z() = pixel.mean(scene_.shown.heights.data()) * scene_.z_mm;
    }
    if (pixel.part == Part::wall) return wall(pixel, lit);
    lit.height = scene_.span_mm > 0 ? (lit.place.z() - scene_.lowest_mm) / scene_.span_mm : 0;
    lit.light = light_.at(lit.place);
    return {shader_.colour(lit), 1};
  }

 private:
  Colour wall(const Pixel& pixel, Lit& lit) const {
    // Leaning to the viewer: plain walls in the dark would look like holes.
    const Vec3f to_viewer = placement_.turn.row(2).transpose().cast<float>();
    lit.normal = (wall_normal(pixel.corners, scene_.topology.places.size()) + .8F * to_viewer).normalized();
    lit.light = {.8F, 1};
    lit.height = .55F;
    return {shader_.colour(lit), 1};
  }

  const PlateScene& scene_;
  const Placement& placement_;
  const LightMap& light_;
  Shader shader_;
};

// The plate's soft shadow on what lies behind it, on a coarse grid.
class Backdrop {
 public:
  explicit Backdrop(const PixelMap& map) {
    while (std::max(map.width, map.height) >> shift_ > 160) ++shift_;
    const int step = 1 << shift_, rows = (map.height >> shift_) + 2;
    columns_ = (map.width >> shift_) + 2;
    shade_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows), 0);
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns_; ++column) {
        const int x = column * step, y = (row - 1) * step;  // moved down: the lamp is above
        if (x >= map.width || y < 0 || y >= map.height) continue;
        const auto at =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) + static_cast<std::size_t>(x);
        shade_[index(column, row)] = map.pixels[at].part == Part::nothing ? 0.F : .38F;
      }
    blur(shade_, columns_, 2);
  }

  float at(int x, int y) const {
    const int column = x >> shift_, row = y >> shift_, rest = (1 << shift_) - 1;
    const float share = 1 / static_cast<float>(rest + 1);
    const float s = static_cast<float>(x & rest) * share, t = static_cast<float>(y & rest) * share;
    const auto between = [&](int r) {
      const float left = shade_[index(column, r)];
      return left + s * (shade_[index(column + 1, r)] - left);
    };
    return between(row) + t * (between(row + 1) - between(row));
  }

 private:
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }

  int shift_ = 0, columns_ = 0;
  std::vector<float> shade_;
};

void store(const Colour& colour, float shade, const DisplayTable& display, std::uint8_t* rgba) {
  const float opacity = colour.coverage + (1 - colour.coverage) * shade;
  const float scale = opacity > 0 && opacity < 1 ? 1 / opacity : 1;
  for (int i = 0; i < 3; ++i) rgba[i] = display(colour.rgb[i] * scale);
  rgba[3] = static_cast<std::uint8_t>(opacity * 255 + .5F);
}

void paint(const Painter& painter, const PixelMap& map, int samples_per_side, Picture& picture) {
  const Backdrop backdrop(map);
  const DisplayTable& display = display_table();
  const int n = samples_per_side;
  const float share = 1 / static_cast<float>(n * n);
  picture.rgba.resize(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height) * 4);
  const auto paint_row = [&](std::size_t row) {
    std::uint8_t* rgba = picture.rgba.data() + row * static_cast<std::size_t>(picture.width) * 4;
    for (int column = 0; column < picture.width; ++column, rgba += 4) {
      Colour sum;
      for (int i = 0; i < n * n; ++i) {
        const int x = column * n + i % n, y = static_cast<int>(row) * n + i / n;
        const auto at =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) + static_cast<std::size_t>(x);
        const Colour part = painter.at(map.pixels[at], x, y);
        sum.rgb += share * part.rgb;
        sum.coverage += share * part.coverage;
      }
      const float shade = sum.coverage < 1 ? backdrop.at(column * n, static_cast<int>(row) * n) : 0;
      store(sum, shade, display, rgba);
    }
  };
  parallel_for(static_cast<std::size_t>(picture.height), paint_row, 8);
}

}  // namespace

struct FrameRenderer::Scenery {
  std::shared_ptr<const ReliefModel> model;
  Topology topology{topology_of(model->surface())};
  std::vector<float> depth;  // of the model itself

  // A picture of triangles that lasts as long as the placement does.
  struct Kept {
    PixelMap map;
    std::optional<Placement> placement;
    double margin_mm = 0, mm_per_unit = 0;
  };
  Kept quick, fine, quick_grid, fine_grid, profile_grid;
  PixelMap turned;

  const PixelMap& map_for(const PlateScene& scene, const Placement& placement, Kept& kept) {
    if (!placement.is_front) {
      draw_pixel_map(raster_scene(scene, placement), topology.parts, turned);
      return turned;
    }
    const RenderOptions& options = scene.options;
    if (kept.placement == placement && kept.margin_mm == options.margin_mm &&
        kept.mm_per_unit == options.mm_per_unit)
      return kept.map;
    draw_pixel_map(raster_scene(scene, placement), topology.parts, kept.map);
    kept.placement = placement;
    kept.margin_mm = options.margin_mm;
    kept.mm_per_unit = options.mm_per_unit;
    return kept.map;
  }

  // Heights over the relief and a little around it.
  HeightField height_field(const PlateScene& scene, int longer_side_px, Kept& kept) {
    const double scale = scene.options.mm_per_unit;
    const Vec2 half = scale * (topology.half + Vec2::Constant(2 * light_margin * topology.half.maxCoeff()));
    HeightField field;
    field.mm_per_pixel = 2 * half.maxCoeff() / longer_side_px;
    field.width = std::max(1, static_cast<int>(2 * half.x() / field.mm_per_pixel));
    field.height = std::max(1, static_cast<int>(2 * half.y() / field.mm_per_pixel));
    field.box.extend({-half.x(), -half.y(), 0});
    field.box.extend({half.x(), half.y(), static_cast<double>(scene.span_mm)});
    const Placement placement{field.width, field.height, 1 / field.mm_per_pixel};
    const PixelMap& map = map_for(scene, placement, kept);
    field.z.resize(map.pixels.size());
    parallel_for(map.pixels.size(), [&](std::size_t i) {
      const Pixel& pixel = map.pixels[i];
      const float z = pixel.part == Part::relief ? pixel.mean(scene.shown.heights.data()) : 0;
      field.z[i] = z * scene.z_mm - scene.lowest_mm;
    });
    return field;
  }
};

FrameRenderer::FrameRenderer(std::shared_ptr<const ReliefModel> model)
    : scenery_(std::make_unique<Scenery>(std::move(model))) {
  const Surface& surface = scenery_->model->surface();
  double lowest = std::numeric_limits<double>::infinity();
  for (const Vec3& p : surface.points) lowest = std::min(lowest, p.z());
  for (const Vec3& p : surface.points) scenery_->depth.push_back(static_cast<float>(p.z() - lowest));
}
FrameRenderer::FrameRenderer(FrameRenderer&&) noexcept = default;
FrameRenderer::~FrameRenderer() = default;

Shown FrameRenderer::original() const {
  return {scenery_->depth, scenery_->model->surface().normals};
}

void FrameRenderer::render(const Shown& shown, const RenderOptions& options, Picture& picture) {
  picture.rgba.clear();
  picture.width = picture.height = 0;
  if (options.width < 1 || options.height < 1 || std::max(options.width, options.height) > largest_side)
    return;
  picture.width = options.width;
  picture.height = options.height;
  const int samples_per_side = options.is_fine ? 2 : 1;
  const PlateScene scene = scene_of(scenery_->topology, shown, options);
  const Placement placement = placement_of(scenery_->topology, options, samples_per_side);
  picture.pixels_per_mm = placement.pixels_per_mm / samples_per_side;
  const Vec3 to_lamp = options.light.cast<double>().normalized();
  const int grid_px = std::clamp(std::max(options.width, options.height) / 3, 120, 280);  // shadows are soft
  HeightField field = options.is_fine ? scenery_->height_field(scene, 640, scenery_->fine_grid)
                                      : scenery_->height_field(scene, grid_px, scenery_->quick_grid);
  const LightMap light(std::move(field), options.has_shadows ? to_lamp : Vec3(Vec3::UnitZ()));
  const PixelMap& map =
      scenery_->map_for(scene, placement, options.is_fine ? scenery_->fine : scenery_->quick);
  paint(Painter(scene, placement, light), map, samples_per_side, picture);
}

std::vector<float> FrameRenderer::profile(const Shown& shown, const RenderOptions& options, const Vec2& from,
                                          const Vec2& to, std::size_t samples) {
  const PlateScene scene = scene_of(scenery_->topology, shown, options);
  const HeightField field = scenery_->height_field(scene, 1400, scenery_->profile_grid);
  std::vector<float> heights(samples);
  for (std::size_t i = 0; i < samples; ++i) {
    const double t = samples > 1 ? static_cast<double>(i) / static_cast<double>(samples - 1) : 0;
    const Vec2 place = from + t * (to - from), pixel = field.to_pixels({place.x(), place.y(), 0});
    const int x = static_cast<int>(std::floor(pixel.x())), y = static_cast<int>(std::floor(pixel.y()));
    if (x < 0 || y < 0 || x >= field.width || y >= field.height) continue;
    const auto at =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(field.width) + static_cast<std::size_t>(x);
    heights[i] = field.z[at] + scene.lowest_mm;
  }
  return heights;
}

}  // namespace relievo
