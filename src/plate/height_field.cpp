#include "plate/height_field.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/raster.h"
#include "geometry/smooth_surface.h"
#include "relievo/core/parallel.h"

namespace relievo {
namespace {

Box front_box(const Solid& solid) {
  Box box;
  for (std::size_t t = 0; t < solid.front_triangles; ++t)
    for (const Index i : solid.triangles[t]) box.extend(solid.points[i]);
  return box;
}

// Heights count from the lowest point, which keeps their single-precision digits.
RasterInput front_input(const Solid& solid, const HeightField& field) {
  RasterInput input;
  input.triangles = std::span(solid.triangles).first(solid.front_triangles);
  input.width = field.z.width;
  input.height = field.z.height;
  input.points.resize(solid.points.size());
  parallel_for(solid.points.size(), [&](std::size_t i) {
    // Points that the front does not use may lie anywhere.
    const Vec3 p = solid.points[i].cwiseMax(field.box.min).cwiseMin(field.box.max);
    const Vec2 place = field.to_pixels(p);
    input.points[i] = {place.x(), place.y(), p.z() - field.box.min.z()};
  });
  return input;
}

// Draws the front; height_of(input, fragment, pixel) is the height above the lowest point where a triangle is seen.
template <typename HeightOf>
void draw(const Solid& solid, HeightField& field, HeightOf height_of) {
  field.is_beside = filled_image(field.z.width, field.z.height, std::uint8_t{1});
  const RasterInput input = front_input(solid, field);
  const int band_rows = 32;
  const Rasterizer rasterizer(input, band_rows);
  const auto draw_band = [&](std::size_t b) {
    const RowBand band = rasterizer.draw(b);
    const std::size_t first = field.z.index(0, band.first_row);
    for (std::size_t i = 0; i < band.fragments.pixels.size(); ++i) {
      const Fragment& fragment = band.fragments.pixels[i];
      if (fragment.triangle == no_index) continue;
      field.is_beside.pixels[first + i] = 0;
      field.z.pixels[first + i] = std::max(0.F, height_of(input, fragment, first + i));
    }
  };
  parallel_for(rasterizer.bands(), draw_band, 1);
}

constexpr double degree = std::numbers::pi / 180;

Vec3 area_normal(const Solid& solid, std::size_t t) {
  const auto& [a, b, c] = solid.triangles[t];
  return (solid.points[b] - solid.points[a]).cross(solid.points[c] - solid.points[a]);
}

// Returns whether a triangle is neither wall nor ground.
std::vector<std::uint8_t> sheet_triangles(const Solid& solid) {
  constexpr double least_wall = 65 * degree;
  const auto is_ground = [&](Index i) { return solid.points[i].z() == solid.ground_mm; };
  std::vector<std::uint8_t> is_sheet(solid.front_triangles);
  parallel_for(is_sheet.size(), [&](std::size_t t) {
    const Vec3 normal = area_normal(solid, t);
    is_sheet[t] = normal.z() > std::cos(least_wall) * normal.norm() &&
                  !std::ranges::all_of(solid.triangles[t], is_ground);
  });
  return is_sheet;
}

// Returns per point how smooth the surface is there: 1 where the triangles around turn little from their mean, 0 at sharp
// edges, walls and ground.
std::vector<float> smoothness(const Solid& solid, std::span<const std::uint8_t> is_sheet) {
  constexpr double smooth_turn = 8 * degree,
                   sharp_turn = 16 * degree;  // the latter about half the angle of an edge
  std::vector<Vec3> sums(solid.points.size(), Vec3::Zero());
  for (std::size_t t = 0; t < is_sheet.size(); ++t)
    for (const Index i : solid.triangles[t])
      if (is_sheet[t]) sums[i] += area_normal(solid, t);
  std::vector<float> shares(solid.points.size(), 1);
  for (std::size_t t = 0; t < is_sheet.size(); ++t) {
    const Vec3 normal = area_normal(solid, t).normalized();
    for (const Index i : solid.triangles[t]) {
      const double turn = std::acos(std::clamp(normal.dot(sums[i].normalized()), -1., 1.));
      const double share = is_sheet[t] ? (sharp_turn - turn) / (sharp_turn - smooth_turn) : 0;
      shares[i] = std::min(shares[i], static_cast<float>(std::max(share, 0.0)));
    }
  }
  return shares;
}

}  // namespace

HeightField flat_height_field(const Box& box, int longer_side_px) {
  HeightField field;
  field.box = box;
  const Vec3 size = box.size();
  const double longer_mm = std::max(size.x(), size.y());
  if (longer_side_px < 1 || longer_side_px > RasterInput::most_pixels || !(longer_mm > 0)) return field;
  field.mm_per_pixel = longer_mm / longer_side_px;
  const auto pixels = [&](double mm) {
    return std::max(1, static_cast<int>(std::lround(mm / field.mm_per_pixel)));
  };
  field.z = filled_image(pixels(size.x()), pixels(size.y()), 0.F);
  return field;
}

HeightField draw_height_field(const Solid& solid, int longer_side_px) {
  HeightField field = flat_height_field(front_box(solid), longer_side_px);
  if (field.z.empty()) return field;
  draw(solid, field, [](const RasterInput&, const Fragment& fragment, std::size_t) { return fragment.z; });
  return field;
}

HeightField draw_smooth_height_field(const Solid& solid, int longer_side_px) {
  HeightField field = flat_height_field(front_box(solid), longer_side_px);
  if (field.z.empty()) return field;
  const std::vector<std::uint8_t> is_sheet = sheet_triangles(solid);
  const SmoothSurface surface(solid.points, std::span(solid.triangles).first(solid.front_triangles),
                              is_sheet);
  const std::vector<float> shares = smoothness(solid, is_sheet);
  const auto width = static_cast<std::size_t>(field.z.width);
  const double span_mm = field.box.size().z();
  draw(solid, field, [&](const RasterInput& input, const Fragment& fragment, std::size_t pixel) {
    const Triangle& corners = solid.triangles[fragment.triangle];
    if (std::ranges::all_of(corners, [&](Index i) { return shares[i] == 0; })) return fragment.z;
    const double x = static_cast<double>(pixel % width) + .5, y = static_cast<double>(pixel / width) + .5;
    const double z = surface.at(fragment.triangle, field.to_mm(x, y)).height - field.box.min.z();
    const Vec3f weights = corner_weights(input, fragment.triangle, x, y);
    const float share = weights.dot(Vec3f(shares[corners[0]], shares[corners[1]], shares[corners[2]]));
    const float smooth = static_cast<float>(std::clamp(z, 0.0, span_mm));
    return fragment.z + std::clamp(share, 0.F, 1.F) * (smooth - fragment.z);
  });
  return field;
}

}  // namespace relievo
