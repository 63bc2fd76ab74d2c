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

// Draws the front; height_of(fragment, pixel) is the height above the lowest point where a triangle is seen.
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
      field.z.pixels[first + i] = std::max(0.F, height_of(fragment, first + i));
    }
  };
  parallel_for(rasterizer.bands(), draw_band, 1);
}

// Returns whether a triangle is neither wall nor ground and its normal near the mean ones at its corners, to which walls
// and ground do not count.
std::vector<std::uint8_t> smooth_triangles(const Solid& solid) {
  constexpr double degree = std::numbers::pi / 180;
  constexpr double most_turn = 12 * degree;  // about half the angle of a sharp edge
  constexpr double least_wall = 65 * degree;
  const auto area_normal = [&](std::size_t t) -> Vec3 {
    const auto& [a, b, c] = solid.triangles[t];
    return (solid.points[b] - solid.points[a]).cross(solid.points[c] - solid.points[a]);
  };
  const auto is_ground = [&](Index i) { return solid.points[i].z() == solid.ground_mm; };
  std::vector<std::uint8_t> is_smooth(solid.front_triangles);
  std::vector<Vec3> sums(solid.points.size(), Vec3::Zero());
  for (std::size_t t = 0; t < is_smooth.size(); ++t) {
    const Vec3 normal = area_normal(t);
    is_smooth[t] = normal.z() > std::cos(least_wall) * normal.norm() &&
                   !std::ranges::all_of(solid.triangles[t], is_ground);
    for (const Index i : solid.triangles[t])
      if (is_smooth[t]) sums[i] += normal;
  }
  parallel_for(is_smooth.size(), [&](std::size_t t) {
    const Vec3 normal = area_normal(t);
    const auto is_near = [&](Index i) {
      return normal.dot(sums[i]) > std::cos(most_turn) * normal.norm() * sums[i].norm();
    };
    is_smooth[t] &= std::ranges::all_of(solid.triangles[t], is_near);
  });
  return is_smooth;
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
  draw(solid, field, [](const Fragment& fragment, std::size_t) { return fragment.z; });
  return field;
}

HeightField draw_smooth_height_field(const Solid& solid, int longer_side_px) {
  HeightField field = flat_height_field(front_box(solid), longer_side_px);
  if (field.z.empty()) return field;
  const std::vector<std::uint8_t> is_smooth = smooth_triangles(solid);
  const SmoothSurface surface(solid.points, std::span(solid.triangles).first(solid.front_triangles),
                              is_smooth);
  const auto width = static_cast<std::size_t>(field.z.width);
  const double span_mm = field.box.size().z();
  draw(solid, field, [&](const Fragment& fragment, std::size_t pixel) {
    if (!is_smooth[fragment.triangle]) return fragment.z;
    const Vec2 place =
        field.to_mm(static_cast<double>(pixel % width) + .5, static_cast<double>(pixel / width) + .5);
    const double z = surface.at(fragment.triangle, place).height - field.box.min.z();
    return static_cast<float>(std::clamp(z, 0.0, span_mm));
  });
  return field;
}

}  // namespace relievo
