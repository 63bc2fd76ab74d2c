#include "relievo/preview.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "blur.h"
#include "geometry/raster.h"
#include "picture/light_map.h"
#include "relievo/core/parallel.h"
#include "relievo/mesh.h"

namespace relievo {
namespace {

constexpr int samples_per_side = 3, samples_per_pixel = 9;
constexpr double padding = 0.06;  // around the plate, as a share of the picture's longer side
constexpr int most_pixels = Drawing::most_pixels / samples_per_side / 2;

// Lamp and sky together never exceed 1, so nothing is clipped; a flat ground comes out light-mid grey.
constexpr float lamp_strength = .77F, sky_strength = .23F;
constexpr float display_gamma = 1.45F;

Box bounds(const Solid& solid, const Mat3& turn) {
  Box box;
  for (const Triangle& t : solid.triangles)
    for (const Index i : t) box.extend(turn * solid.points[i]);
  return box;
}

// ---------------------------------------------------------------------------------------------------- light

bool is_relief(const Solid& solid, std::size_t t) {
  return t < solid.front_triangles && (solid.regions.empty() || solid.regions[t] == Region::relief);
}

// Unit normals of the relief's points, weighted by the areas around them. Other triangles take no part: they
// are large and thin, and would smear the relief's rim across the ground.
std::vector<Vec3f> relief_normals(const Solid& solid) {
  std::vector<Vec3f> normals(solid.points.size(), Vec3f::Zero());
  for (std::size_t t = 0; t < solid.front_triangles; ++t) {
    if (!is_relief(solid, t)) continue;
    const Triangle& corners = solid.triangles[t];
    const Vec3 p = solid.points[corners[1]] - solid.points[corners[0]],
               q = solid.points[corners[2]] - solid.points[corners[0]];
    const Vec3f twice_area = p.cross(q).cast<float>();
    for (const Index i : corners) normals[i] += twice_area;
  }
  parallel_for(normals.size(), [&](std::size_t i) { normals[i].normalize(); });
  return normals;
}

// Normals of the corners of all other triangles: round where they bend a little within their region.
constexpr double sharpest_deg = 20;
struct PlateNormals {
  std::vector<Index> place;  // per triangle; no_index for the relief's
  std::vector<std::array<Vec3f, 3>> corners;
};

PlateNormals plate_normals(const Solid& solid) {
  PlateNormals normals{std::vector<Index>(solid.triangles.size(), no_index), {}};
  const auto add = [&](auto&& is_part) {
    Mesh part{solid.points, {}};
    const std::size_t begin = normals.corners.size();
    for (std::size_t t = 0; t < solid.triangles.size(); ++t) {
      if (is_relief(solid, t) || !is_part(t)) continue;
      normals.place[t] = static_cast<Index>(begin + part.triangles.size());
      part.triangles.push_back(solid.triangles[t]);
    }
    const auto smooth = smooth_normals(part, sharpest_deg);
    normals.corners.insert(normals.corners.end(), smooth.begin(), smooth.end());
  };
  const auto is_front = [&](std::size_t t) { return t < solid.front_triangles; };
  add([&](std::size_t t) { return is_front(t) && solid.regions[t] == Region::ground; });
  add([&](std::size_t t) { return is_front(t) && solid.regions[t] == Region::bevel; });
  add([&](std::size_t t) { return !is_front(t); });
  return normals;
}

// What the renderer knows of the plate, the same for both views: light belongs to the plate, not to the
// viewer.
struct Model {
  const Solid& solid;
  std::vector<Vec3f> normals;
  PlateNormals plate;
  Vec3f to_lamp, to_sky;
  LightMap light_map;

  Light facing(const Vec3f& normal) const {
    return {std::max(0.F, normal.dot(to_lamp)), .5F + .5F * normal.dot(to_sky)};
  }
};

// The sky is brightest on the side opposite to the lamp: slopes turned away from it keep their form.
Vec3f brightest_sky(const Vec3& to_lamp) {
  return Vec3(-.35 * to_lamp.x(), -.2 * to_lamp.y(), .9).normalized().cast<float>();
}

// Light at a place in the picture, which shows triangle `t`.
Light light_at(const Model& model, const Drawing& scene, Index t, const Vec2& place) {
  const Triangle& corners = model.solid.triangles[t];
  const Vec3f weights = corner_weights(scene, t, place.x(), place.y());
  Vec3f normal = Vec3f::Zero();
  Vec3 point = Vec3::Zero();
  const Index on_plate = model.plate.place[t];
  for (int i = 0; i < 3; ++i) {
    normal +=
        weights[i] * (on_plate == no_index ? model.normals[corners[i]] : model.plate.corners[on_plate][i]);
    point += weights[i] * model.solid.points[corners[i]];
  }
  const Light facing = model.facing(normal.normalized());
  const float share = .78F;  // what hangs behind the plate hides some: its edge stands out from the ground
  if (t >= model.solid.front_triangles) return {facing.lamp * share, facing.sky * share};
  const Light reaching = model.light_map.at(point.cast<float>());
  return {facing.lamp * reaching.lamp, facing.sky * reaching.sky};
}

// ---------------------------------------------------------------------------------------------------- views

// One of the two pictures.
struct View {
  Mat3 turn;  // from the solid to the viewer: x to the right, y up, z towards the viewer
  double pixels_per_mm = 1;
  int width = 0, height = 0;
};

Mat3 oblique_turn() {
  const double degree = std::numbers::pi / 180;
  return (Eigen::AngleAxisd(20 * degree, Vec3::UnitX()) * Eigen::AngleAxisd(-35 * degree, Vec3::UnitY()))
      .matrix();
}

std::array<View, 2> views_of(const Solid& solid, int longer_side_px) {
  const Mat3 turn = oblique_turn();
  const Vec3 front = bounds(solid, Mat3::Identity()).size(), side = bounds(solid, turn).size();
  const double longer = std::max(front.x(), front.y());
  const double scale = longer_side_px * (1 - 2 * padding) / longer, pad = 2 * padding * longer_side_px;
  const auto pixels = [&](double mm) { return std::max(1, static_cast<int>(std::lround(mm * scale + pad))); };
  const View view{Mat3::Identity(), scale, pixels(front.x()), pixels(front.y())};
  const double fit = std::min((view.width - pad) / side.x(), (view.height - pad) / side.y());
  return {view, {turn, std::min(scale, fit), view.width, view.height}};
}

Drawing scene_of(const Solid& solid, const View& view) {
  Drawing scene;
  scene.triangles = solid.triangles;
  scene.width = view.width * samples_per_side;
  scene.height = view.height * samples_per_side;
  scene.points.resize(solid.points.size());
  const Box box = bounds(solid, view.turn);
  const double scale = view.pixels_per_mm * samples_per_side;
  const Vec3 middle(scene.width / 2.0, scene.height / 2.0, 0);
  parallel_for(solid.points.size(), [&](std::size_t i) {
    const Vec3 p = (view.turn * solid.points[i]).cwiseMax(box.min).cwiseMin(box.max) - box.centre();
    scene.points[i] = middle + scale * Vec3(p.x(), -p.y(), p.z());
  });
  return scene;
}

// --------------------------------------------------------------------------------------------------- pixels

// A view's pixels before they become colours.
struct Layer {
  int width = 0, height = 0;
  std::vector<Light> light;     // mean over the whole pixel: 0 where the plate is not
  std::vector<float> coverage;  // share of the pixel that shows the plate

  std::size_t at(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column);
  }
};

// A triangle that some of a pixel's samples show.
struct Seen {
  Index triangle = no_index;
  int samples = 0;
  Vec2 places = Vec2::Zero();  // their sum
};

// The triangles that a pixel's samples show, each once: light is computed for triangles, not for samples.
int find_seen(const Drawing& scene, const Band& band, int row, int column,
              std::array<Seen, samples_per_pixel>& seen) {
  const int n = samples_per_side;
  int count = 0;
  for (int y = row * n; y < row * n + n; ++y) {
    const Sample* const samples = band.samples.data() + std::ptrdiff_t{y - band.first_row} * scene.width;
    for (int x = column * n; x < column * n + n; ++x) {
      const Index t = samples[x].triangle;
      if (t == no_index) continue;
      int i = 0;
      while (i < count && seen[i].triangle != t) ++i;
      if (i == count) seen[count++] = {t, 0, Vec2::Zero()};
      ++seen[i].samples;
      seen[i].places += Vec2(x + .5, y + .5);
    }
  }
  return count;
}

void gather(const Model& model, const Drawing& scene, const Band& band, int row, int column, Layer& layer) {
  std::array<Seen, samples_per_pixel> seen;
  const int count = find_seen(scene, band, row, column, seen);
  Light& light = layer.light[layer.at(column, row)];
  float& coverage = layer.coverage[layer.at(column, row)];
  for (int i = 0; i < count; ++i) {
    const Light part = light_at(model, scene, seen[i].triangle, seen[i].places / seen[i].samples);
    const float share = static_cast<float>(seen[i].samples) / samples_per_pixel;
    light.lamp += share * part.lamp;
    light.sky += share * part.sky;
    coverage += share;
  }
}

Layer draw(const Model& model, const View& view) {
  const Drawing scene = scene_of(model.solid, view);
  const auto pixels = static_cast<std::size_t>(view.width) * static_cast<std::size_t>(view.height);
  Layer layer{view.width, view.height, std::vector<Light>(pixels), std::vector<float>(pixels)};
  const Raster raster(scene, 12 * samples_per_side);
  parallel_for(
      raster.bands(),
      [&](std::size_t b) {
        const Band band = raster.draw(b);
        const int first = band.first_row / samples_per_side, rows = band.rows / samples_per_side;
        for (int row = first; row < first + rows; ++row)
          for (int column = 0; column < layer.width; ++column) gather(model, scene, band, row, column, layer);
      },
      1);
  return layer;
}

// --------------------------------------------------------------------------------------------------- colours

// Grey levels for light in [0, 1]; fine enough that a level is never off by more than one.
class Tones {
 public:
  Tones() {
    for (std::size_t i = 0; i < levels_.size(); ++i)
      levels_[i] =
          static_cast<std::uint8_t>(std::pow(static_cast<float>(i) / most, 1 / display_gamma) * 255 + .5F);
  }
  std::uint8_t operator()(float light) const {
    return levels_[static_cast<std::size_t>(std::clamp(light, 0.F, 1.F) * most + .5F)];
  }

 private:
  static constexpr float most = 8191;
  std::array<std::uint8_t, 8192> levels_;
};

// The plate's shadow on the wall behind it, in [0, 1].
std::vector<float> shadow_behind(const Layer& layer, int size) {
  std::vector<float> spread = layer.coverage, shadow(spread.size());
  blur(spread, layer.width, size);
  parallel_for(static_cast<std::size_t>(layer.height), [&](std::size_t r) {
    const int row = static_cast<int>(r);
    for (int column = size / 2; column < layer.width && row >= size; ++column)
      shadow[layer.at(column, row)] = spread[layer.at(column - size / 2, row - size)];
  });
  return shadow;
}

void paint(const Layer& layer, int left, const Vec3f& colour, Image8& image) {
  const std::vector<float> shadow =
      shadow_behind(layer, std::max(1, std::max(layer.width, layer.height) / 90));
  const Tones tone;
  parallel_for(
      static_cast<std::size_t>(layer.height),
      [&](std::size_t row) {
        const float wall = .90F - .20F * static_cast<float>(row) / static_cast<float>(layer.height);
        auto pixel =
            image.pixels.begin() + (static_cast<std::ptrdiff_t>(row) * image.width + left) * image.channels;
        for (int column = 0; column < layer.width; ++column) {
          const std::size_t i = layer.at(column, static_cast<int>(row));
          const float behind = (1 - layer.coverage[i]) * wall * (1 - .45F * shadow[i]);
          const float light = lamp_strength * layer.light[i].lamp + sky_strength * layer.light[i].sky;
          for (const float share : colour) *pixel++ = tone(light * share + behind);
        }
      },
      16);
}

}  // namespace

Image8 render_preview(const Solid& solid, const PreviewOptions& options) {
  if (bounds(solid, Mat3::Identity()).is_empty() || options.longer_side_px < 1 ||
      options.longer_side_px > most_pixels)
    return {};
  const Vec3 to_lamp = options.light.stableNormalized();
  const int light_map_px = std::max(1, options.longer_side_px / 2);
  const Model model{solid,
                    relief_normals(solid),
                    plate_normals(solid),
                    to_lamp.cast<float>(),
                    brightest_sky(to_lamp),
                    LightMap(solid, to_lamp, light_map_px)};
  const auto views = views_of(solid, options.longer_side_px);
  Image8 image{2 * views[0].width, views[0].height, 3, {}};
  image.pixels.resize(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 3);
  paint(draw(model, views[0]), 0, options.colour, image);
  paint(draw(model, views[1]), views[0].width, options.colour, image);
  return image;
}

}  // namespace relievo
