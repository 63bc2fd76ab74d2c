#include "relievo/render.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "blur.h"
#include "pixel_map.h"
#include "relievo/parallel.h"
#include "relievo/solid.h"
#include "shading.h"

namespace relievo {
namespace {

constexpr int largest_side = 8192;
constexpr double padding = .055;      // around the plate, as a share of the picture's shorter side
constexpr double light_margin = .06;  // of the map of light around the relief, as a share of its longer side
constexpr double farthest_px = 100000;  // from the picture's middle, what a raster can take

Mat3 turn_of(const Camera& camera) {
  const double degree = std::numbers::pi / 180;
  return (Eigen::AngleAxisd(camera.pitch_deg * degree, Vec3::UnitX()) *
          Eigen::AngleAxisd(camera.yaw_deg * degree, Vec3::UnitY()))
      .matrix();
}

// The plate's triangles; heights and corners move, these do not.
struct Topology {
  std::vector<Triangle> triangles;
  std::vector<Part> parts;   // per triangle
  std::vector<Vec2> places;  // of the surface's points from the middle, in its units
  Vec2 half = Vec2::Zero();  // half the size of their box
};

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

// Where the plate lies in the picture: pixel = middle + pixels_per_mm * turn * (place - pan), y downwards.
struct Placement {
  int width = 0, height = 0;
  double pixels_per_mm = 1;
  Mat3 turn = Mat3::Identity();
  Vec3 pan = Vec3::Zero();
  bool is_front = true;

  Vec3 to_picture(const Vec3& place) const {
    const Vec3 p = pixels_per_mm * (turn * (place - pan));
    return {width / 2.0 + std::clamp(p.x(), -farthest_px, farthest_px),
            height / 2.0 - std::clamp(p.y(), -farthest_px, farthest_px), p.z()};
  }
  Vec3f to_place(double x, double y, double z) const {
    if (is_front)
      return {static_cast<float>((x - width / 2.0) * (1 / pixels_per_mm) + pan.x()),
              static_cast<float>((height / 2.0 - y) * (1 / pixels_per_mm) + pan.y()), 0};
    const Vec3 p = Vec3(x - width / 2.0, height / 2.0 - y, z) / pixels_per_mm;
    return (turn.transpose() * p + pan).cast<float>();
  }
  bool operator==(const Placement&) const = default;
};

// What all pixels of a picture share.
struct Scene3 {
  const Topology& topology;
  const Shown& shown;
  const RenderOptions& options;
  float lowest_mm = 0, span_mm = 0;  // of the heights, ground included
};

Scene3 scene_of(const Topology& topology, const Shown& shown, const RenderOptions& options) {
  const auto [lowest, highest] = std::ranges::minmax(shown.heights);
  const auto scale = static_cast<float>(options.mm_per_unit);
  const float low = std::min(0.F, lowest) * scale, high = std::max(0.F, highest) * scale;
  return {topology, shown, options, low, high - low};
}

Vec2 half_plate(const Topology& topology, const RenderOptions& options) {
  return options.mm_per_unit * topology.half + Vec2::Constant(options.margin_mm);
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

// Seen from the front, heights make no difference and are left out.
Scene raster_scene(const Scene3& scene, const Placement& placement) {
  const auto& places = scene.topology.places;
  const double scale = scene.options.mm_per_unit;
  Scene raster;
  raster.triangles = scene.topology.triangles;
  raster.width = placement.width;
  raster.height = placement.height;
  raster.points.resize(places.size() + 8);
  parallel_for(places.size(), [&](std::size_t i) {
    const double z = placement.is_front ? 0 : static_cast<double>(scene.shown.heights[i]);
    raster.points[i] = placement.to_picture(scale * Vec3(places[i].x(), places[i].y(), z));
  });
  const Vec2 half = half_plate(scene.topology, scene.options);
  const double bottom = static_cast<double>(scene.lowest_mm) - scene.options.thickness_mm;
  for (std::size_t i = 0; i < 8; ++i) {  // in the order of make_plate()
    const double x = i % 4 == 1 || i % 4 == 2 ? half.x() : -half.x(), y = i % 4 >= 2 ? half.y() : -half.y();
    raster.points[places.size() + i] = placement.to_picture({x, y, i < 4 ? 0 : bottom});
  }
  return raster;
}

Vec3f wall_normal(const Triangle& corners, std::size_t first_rectangle) {
  const auto is_bottom = [&](Index i) { return i >= first_rectangle + 4; };
  if (is_bottom(corners[0]) && is_bottom(corners[1]) && is_bottom(corners[2])) return -Vec3f::UnitZ();
  // A wall runs between two neighbouring corners: 0-1 below, 1-2 right, 2-3 above, 3-0 left.
  bool has[4] = {};
  for (const Index i : corners) has[(i - first_rectangle) % 4] = true;
  if (has[0] && has[1]) return -Vec3f::UnitY();
  if (has[1] && has[2]) return Vec3f::UnitX();
  return has[2] && has[3] ? Vec3f(Vec3f::UnitY()) : Vec3f(-Vec3f::UnitX());
}

// ---------------------------------------------------------------------------------------------------- pixels

struct Colour {
  Vec3f rgb = Vec3f::Zero();
  float coverage = 0;
};

class Painter {
 public:
  Painter(const Scene3& scene, const Placement& placement, const LightMap& light)
      : scene_(scene),
        placement_(placement),
        light_(light),
        shader_(scene.options.material, scene.options.light.normalized(),
                placement.turn.row(2).transpose().cast<float>()) {}

  Colour at(const Pixel& pixel, int column, int row) const {
    if (pixel.part == Part::nothing) return {};
    const float scale = static_cast<float>(scene_.options.mm_per_unit);
    Lit lit{Vec3f::UnitZ(), {1, 1}, placement_.to_place(column + .5, row + .5, static_cast<double>(pixel.z))};
    if (pixel.part == Part::relief) {
      lit.normal = pixel.mean(scene_.shown.normals.data()).normalized();
      lit.place.z() = pixel.mean(scene_.shown.heights.data()) * scale;
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
    lit.light = {.7F, .75F};
    lit.height = .55F;
    return {shader_.colour(lit), 1};
  }

  const Scene3& scene_;
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

  const PixelMap& map_for(const Scene3& scene, const Placement& placement, Kept& kept) {
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
  HeightField height_field(const Scene3& scene, int longer_side_px, Kept& kept) {
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
      field.z[i] = z * static_cast<float>(scale) - scene.lowest_mm;
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
  const Scene3 scene = scene_of(scenery_->topology, shown, options);
  const Placement placement = placement_of(scenery_->topology, options, samples_per_side);
  picture.pixels_per_mm = placement.pixels_per_mm / samples_per_side;
  const Vec3 to_lamp = options.light.cast<double>().normalized();
  HeightField field = options.is_fine ? scenery_->height_field(scene, 640, scenery_->fine_grid)
                                      : scenery_->height_field(scene, 280, scenery_->quick_grid);
  const LightMap light(std::move(field), options.has_shadows ? to_lamp : Vec3(Vec3::UnitZ()));
  const PixelMap& map =
      scenery_->map_for(scene, placement, options.is_fine ? scenery_->fine : scenery_->quick);
  paint(Painter(scene, placement, light), map, samples_per_side, picture);
}

std::vector<float> FrameRenderer::profile(const Shown& shown, const RenderOptions& options, const Vec2& from,
                                          const Vec2& to, std::size_t samples) {
  const Scene3 scene = scene_of(scenery_->topology, shown, options);
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
