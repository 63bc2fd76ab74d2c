#include "picture/draw_body.h"

#include <algorithm>
#include <cmath>

#include "geometry/image_filters.h"
#include "picture/shading.h"
#include "relievo/core/parallel.h"
#include "relievo/core/types.h"
#include "relievo/picture/render.h"

namespace relievo {
namespace {

// A soft shadow needs few pixels, so the longer side of its coarse grid has at most this many cells.
constexpr int most_cells = 160;

// Opacity of the full shadow, similar to the shadow on a table in a bright room with a lamp.
constexpr float shadow_opacity = .4F;

// The radius of the shadow's soft edge, and the largest offset of a shadow from its body, both in cells. The
// values suit the thickness of a plate.
constexpr int softness = 2;
constexpr float farthest = 2;

class DropShadow {
 public:
  DropShadow(const Image8& picture, const Vec3f& to_lamp) {
    while (std::max(picture.width, picture.height) >> shift_ > most_cells) ++shift_;
    away_ = -farthest * Vec2f(to_lamp.x(), -to_lamp.y());
    const int step = 1 << shift_;
    shade_ = filled_image((picture.width >> shift_) + 2, (picture.height >> shift_) + 2, 0.F);
    for (int y = 0; y * step < picture.height; ++y)
      for (int x = 0; x * step < picture.width; ++x)
        shade_.at(x, y) = static_cast<float>(picture.pixels[picture.index(x * step, y * step) + 3]) / 255;
    for (float& shade : shade_.pixels) shade *= shadow_opacity;
    blur(shade_, softness);
  }

  // Returns the opacity of the shadow at a pixel, interpolated between cells.
  float at(int x, int y) const {
    const float share = 1 / static_cast<float>(1 << shift_);
    const float u = clamped(static_cast<float>(x) * share - away_.x(), shade_.width),
                v = clamped(static_cast<float>(y) * share - away_.y(), shade_.height);
    const int column = static_cast<int>(u), row = static_cast<int>(v);
    const float s = u - static_cast<float>(column), t = v - static_cast<float>(row);
    const auto between = [&](int r) {
      const float left = shade_.at(column, r);
      return left + s * (shade_.at(column + 1, r) - left);
    };
    return between(row) + t * (between(row + 1) - between(row));
  }

 private:
  static float clamped(float cell, int cells) {
    return std::clamp(cell, 0.F, static_cast<float>(cells) - 1.001F);
  }

  int shift_ = 0;
  Vec2f away_;  // offset of the shadow, in cells
  Image<float> shade_;
};

// Composites a pixel over black of opacity `shade`.
void lay_over(std::uint8_t* rgba, float shade) {
  const float coverage = static_cast<float>(rgba[3]) / 255, opacity = coverage + (1 - coverage) * shade;
  if (opacity <= 0) return;
  for (int i = 0; i < 3; ++i)
    rgba[i] = static_cast<std::uint8_t>(static_cast<float>(rgba[i]) * (coverage / opacity) + .5F);
  rgba[3] = static_cast<std::uint8_t>(opacity * 255 + .5F);
}

// The opaque pixels of a picture with 4 channels cast a shadow. Draws this shadow onto the other pixels, as
// black with some opacity. `to_lamp` is the direction to the lamp in the picture: y upwards, unit length.
void add_drop_shadow(Image8& picture, const Vec3f& to_lamp) {
  const DropShadow shadow(picture, to_lamp);
  const auto add_to_row = [&](std::size_t row) {
    const int y = static_cast<int>(row);
    std::uint8_t* rgba = &picture.at(0, y);
    for (int x = 0; x < picture.width; ++x, rgba += 4)
      if (rgba[3] < 255) lay_over(rgba, shadow.at(x, y));
  };
  parallel_for(static_cast<std::size_t>(picture.height), add_to_row, 8);
}

// Number of samples per pixel of fine pictures, in each direction. With 3 x 3 samples the steps along
// slanted edges are invisible.
constexpr int fine_samples = 3;
constexpr int most_samples = fine_samples * fine_samples;

// Longer side of the light map, in pixels. Shadows are soft, so the map may be coarser than the picture. For
// live pictures it is so small that shadows take only a few milliseconds.
constexpr int fine_light_px = 640, least_light_px = 120, most_quick_light_px = 280;

int light_map_px(const ScreenTransform& transform, bool is_fine) {
  const int side = std::max(transform.width, transform.height);
  return is_fine ? std::max(fine_light_px, side / 2)
                 : std::clamp(side / 3, least_light_px, most_quick_light_px);
}

// Walls and bottom get uniform light. Its share of the lamp's light is slightly less than on the front, so
// that the front's edge is visible. The normals of walls and bottom are turned towards the viewer, because
// dark walls would look like holes.
constexpr Light wall_light{.8F, 1};
constexpr float wall_lean = .8F;
constexpr float wall_height = .55F;  // porcelain walls transmit light like a plate of about mean thickness

// Linear colours of a body's tint where the share of tint is 0 and where it is 1.
const Vec3f no_tint(.25F, .4F, 1), full_tint(1, .35F, .05F);

// Returns the difference between the surface detail at `place` and the surface's own normal there. The
// detail is interpolated bilinearly between the centres of cells.
Vec2f fine_part(const SurfaceDetail& detail, const Vec2f& place, const Vec2f& own) {
  const Vec2f at = (place - detail.corner) / detail.cell - Vec2f::Constant(.5F);
  const int x = static_cast<int>(std::floor(at.x())), y = static_cast<int>(std::floor(at.y()));
  if (!detail.xy.contains(x, y) || !detail.xy.contains(x + 1, y + 1)) return Vec2f::Zero();
  const float s = at.x() - static_cast<float>(x), t = at.y() - static_cast<float>(y);
  const Vec2f below = detail.xy.at(x, y) + s * (detail.xy.at(x + 1, y) - detail.xy.at(x, y)),
              above = detail.xy.at(x, y + 1) + s * (detail.xy.at(x + 1, y + 1) - detail.xy.at(x, y + 1));
  const Vec2f mean = below + t * (above - below);
  return mean.allFinite() ? Vec2f(mean - own) : Vec2f(Vec2f::Zero());
}

// Computes the colour of points on a body.
class Painter {
 public:
  Painter(const DrawnBody& body, const ScreenTransform& transform, const LightMap& light,
          const DrawParams& params)
      : body_(body),
        transform_(transform),
        light_(light),
        to_viewer_(transform.to_viewer()),
        middle_(body.front.centre().head<2>().cast<float>()),
        half_side_mm_(std::max(1e-6F, static_cast<float>(body.front.longer_side()) / 2)),
        shader_(params.material, direction_of(params.light), to_viewer_),
        tint_(params.reach, body.front) {}

  // Returns the linear colour of a visible point. x and y are its position in the picture, in pixels of the transform.
  Vec3f colour(const VisiblePoint& seen, float x, float y) const {
    Lit lit{Vec3f::UnitZ(),
            {1, 1},
            transform_.to_body(static_cast<double>(x), static_cast<double>(y), static_cast<double>(seen.z))};
    lit.from_middle = (lit.place.head<2>() - middle_) / half_side_mm_;
    if (seen.part == Part::wall) {
      lit.normal = (corner_normal(seen) + wall_lean * to_viewer_).normalized();
      lit.light = wall_light;
      lit.height = wall_height;
      return shader_.colour(lit);
    }
    if (seen.part == Part::relief) lit.normal = relief_normal(seen, lit.place.head<2>());
    if (seen.part == Part::curved) lit.normal = corner_normal(seen);
    lit.place.z() = height_mm(body_, seen);
    lit.height = body_.span_mm() > 0 ? (lit.place.z() - body_.lowest_mm()) / body_.span_mm() : 0;
    lit.light = light_.at(lit.place);
    if (body_.parts.has_curved_ground) lit.light = faded(lit.light, lit.normal);
    return tinted(tint_(shader_.colour(lit), lit.place), seen);
  }

 private:
  Vec3f relief_normal(const VisiblePoint& seen, const Vec2f& place_mm) const {
    const auto& [a, b, c] = seen.corners;
    if (body_.heights[a] == body_.heights[b] && body_.heights[a] == body_.heights[c]) return Vec3f::UnitZ();
    Vec3f normal = seen.mean(body_.normals[a], body_.normals[b], body_.normals[c]);
    if (body_.detail) {
      const SurfaceDetail& detail = *body_.detail;
      const Vec2f at = place_mm / static_cast<float>(body_.mm_per_place) + body_.middle;
      const float gain = seen.mean(body_.gains[a], body_.gains[b], body_.gains[c]);
      const Vec2f own = seen.mean(detail.own[a], detail.own[b], detail.own[c]);
      normal.head<2>() -= normal.z() * gain * fine_part(detail, at, own);
    }
    normal.head<2>() *= body_.stretch;
    return normal.normalized();
  }

  // Returns the colour with the body's tint. The brightness does not change.
  Vec3f tinted(const Vec3f& colour, const VisiblePoint& seen) const {
    if (body_.tint.empty() || seen.part != Part::relief) return colour;
    const auto& [a, b, c] = seen.corners;
    const float share = seen.mean(body_.tint[a], body_.tint[b], body_.tint[c]);
    const Vec3f hue = no_tint + share * (full_tint - no_tint);
    return colour.mean() / hue.mean() * hue;
  }

  // Returns the light, with the light map's shadows faded out where the surface turns away from the front.
  // The map is computed for the front view, so it is wrong on the sides and the back of a bent body.
  static Light faded(const Light& light, const Vec3f& normal) {
    constexpr float hardly_seen = .35F, well_seen = .65F;
    const float share = std::clamp((normal.z() - hardly_seen) / (well_seen - hardly_seen), 0.F, 1.F);
    return {1 + share * (light.lamp - 1), 1 + share * (light.sky - 1)};
  }

  Vec3f corner_normal(const VisiblePoint& seen) const {
    const auto& [a, b, c] = body_.parts.corner_normals[body_.parts.corners_at[seen.triangle]];
    return seen.mean(a, b, c).normalized();
  }

  const DrawnBody& body_;
  const ScreenTransform& transform_;
  const LightMap& light_;
  Vec3f to_viewer_;
  Vec2f middle_;
  float half_side_mm_;
  Shader shader_;
  ReachTint tint_;
};

void store(const Vec3f& colour, float coverage, const DisplayTable& display, std::uint8_t* rgba) {
  if (coverage <= 0) {
    std::fill_n(rgba, 4, std::uint8_t{0});
    return;
  }
  for (int i = 0; i < 3; ++i) rgba[i] = display(colour[i] / coverage);
  rgba[3] = static_cast<std::uint8_t>(coverage * 255 + .5F);
}

// A triangle that is visible in at least one sample of a pixel.
struct SeenTriangle {
  Index triangle = no_index;
  int samples = 0;
  Vec3f places = Vec3f::Zero();  // sum of the positions of the samples
};

// Finds the triangles that are visible in the n x n samples of a pixel. Lists each triangle once, because
// colours are computed once per triangle. Returns the number of triangles.
int find_seen(const RowBand& band, int column, int row, int n, std::array<SeenTriangle, most_samples>& seen) {
  int count = 0;
  for (int y = row * n; y < row * n + n; ++y) {
    const Fragment* const fragments = &band.fragments.at(0, y - band.first_row);
    for (int x = column * n; x < column * n + n; ++x) {
      const Index t = fragments[x].triangle;
      if (t == no_index) continue;
      int i = 0;
      while (i < count && seen[i].triangle != t) ++i;
      if (i == count) seen[count++] = {t, 0, Vec3f::Zero()};
      ++seen[i].samples;
      seen[i].places += Vec3f(static_cast<float>(x) + .5F, static_cast<float>(y) + .5F, fragments[x].z);
    }
  }
  return count;
}

// Draws with n x n samples per pixel, until cancelled. The painter's transform is in units of samples.
void draw_triangles(const DrawnBody& body, const RasterInput& input, const Painter& painter, int n,
                    const Progress* progress, Image8& picture) {
  const Rasterizer rasterizer(input, 12 * n);
  const DisplayTable& display = display_table();
  const float share = 1 / static_cast<float>(n * n);
  const auto draw_band = [&](std::size_t b) {
    if (!check_cancelled(progress)) return;
    const RowBand band = rasterizer.draw(b);
    std::array<SeenTriangle, most_samples> seen;
    for (int row = band.first_row / n; row < (band.first_row + band.fragments.height) / n; ++row) {
      std::uint8_t* rgba = &picture.at(0, row);
      for (int column = 0; column < picture.width; ++column, rgba += 4) {
        Vec3f sum = Vec3f::Zero();
        int covered = 0;
        const int count = find_seen(band, column, row, n, seen);
        for (int i = 0; i < count; ++i) {
          const auto samples = static_cast<float>(seen[i].samples);
          const Vec3f place = seen[i].places / samples;
          const VisiblePoint point = visible_point(body, input, seen[i].triangle, place);
          sum += share * samples * painter.colour(point, place.x(), place.y());
          covered += seen[i].samples;
        }
        store(sum, share * static_cast<float>(covered), display, rgba);
      }
    }
  };
  parallel_for(rasterizer.bands(), draw_band, 1);
}

// Draws the triangles of a visibility buffer, with one sample per pixel.
void draw_visible(const VisibilityBuffer& visible, const Painter& painter, Image8& picture) {
  const DisplayTable& display = display_table();
  const auto draw_row = [&](std::size_t r) {
    const int row = static_cast<int>(r);
    std::uint8_t* rgba = &picture.at(0, row);
    for (int column = 0; column < picture.width; ++column, rgba += 4) {
      const VisiblePoint& seen = visible.at(column, row);
      if (seen.part == Part::nothing)
        std::fill_n(rgba, 4, std::uint8_t{0});
      else
        store(painter.colour(seen, static_cast<float>(column) + .5F, static_cast<float>(row) + .5F), 1,
              display, rgba);
    }
  };
  parallel_for(static_cast<std::size_t>(picture.height), draw_row, 8);
}

}  // namespace

HeightField front_heights(const DrawnBody& body, int longer_side_px, CachedVisibility& cache) {
  HeightField field = flat_height_field(body.front, {longer_side_px});
  if (field.z.empty()) return field;
  ScreenTransform from_above;
  from_above.width = field.z.width;
  from_above.height = field.z.height;
  from_above.pixels_per_mm = 1 / field.mm_per_pixel;
  from_above.pan << body.front.centre().head<2>(), 0;
  DrawnBody front = body;
  front.triangles = body.triangles.first(body.parts.front_triangles);
  const VisibilityBuffer& visible = cache.get(front, from_above);
  parallel_for(visible.pixels.size(), [&](std::size_t i) {
    const VisiblePoint& seen = visible.pixels[i];
    field.z.pixels[i] = seen.part == Part::nothing ? 0 : height_mm(body, seen) - body.lowest_mm();
  });
  if (body.is_rectangle) return field;  // then the front covers all pixels
  field.is_beside.resize(field.z.width, field.z.height);
  std::ranges::transform(visible.pixels, field.is_beside.pixels.begin(),
                         [](const VisiblePoint& seen) { return seen.part == Part::nothing; });
  return field;
}

void draw_body(const DrawnBody& body, const ScreenTransform& transform, const DrawParams& params,
               DrawCache& cache, Image8& picture) {
  picture.resize(transform.width, transform.height, 4);
  const Vec3f to_lamp = direction_of(params.light);
  const LightMap light(params.has_shadows
                           ? front_heights(body, light_map_px(transform, params.is_fine),
                                           params.is_fine ? cache.fine_light : cache.quick_light)
                           : HeightField{},
                       to_lamp);
  if (!check_cancelled(params.progress)) return;
  const int n = params.is_fine ? fine_samples : 1;
  const ScreenTransform samples = transform.finer(n);
  const Painter painter(body, samples, light, params);
  if (n == 1 && body.is_height_field && transform.is_front)
    draw_visible(cache.front.get(body, samples), painter, picture);
  else
    draw_triangles(body, raster_input(body, samples), painter, n, params.progress, picture);
  add_drop_shadow(picture, transform.R_screen_body.cast<float>() * to_lamp);
}

}  // namespace relievo
