#include "plate/height_field.h"

#include <array>

#include "geometry/raster.h"
#include "geometry/weld.h"
#include "plate/coincident_points.h"
#include "relievo/core/parallel.h"

namespace relievo {
namespace {

// Returns the front's triangles in pixel coordinates. Heights are measured from the lowest point, because
// single precision is finest near 0.
RasterInput front_input(const Solid& solid, const HeightField& field) {
  RasterInput input;
  input.triangles = std::span(solid.triangles).first(solid.front_triangles);
  input.width = field.z.width;
  input.height = field.z.height;
  input.points.resize(solid.points.size());
  parallel_for(solid.points.size(), [&](std::size_t i) {
    // Points that the front does not use may lie outside the box.
    const Vec3 p = solid.points[i].cwiseMax(field.box.min).cwiseMin(field.box.max);
    const Vec2 place = field.to_pixels(p);
    input.points[i] = {place.x(), place.y(), p.z() - field.box.min.z()};
  });
  return input;
}

// The ends of the segment in which a line of constant y intersects a triangle.
struct Chord {
  Vec2 left, right;  // x and z
};

// Returns the part of the line of constant `y` that is inside a triangle. The line must intersect the
// triangle.
Chord chord_at(const std::array<Vec3, 3>& corners, double y) {
  Chord chord{Vec2::Constant(std::numeric_limits<double>::infinity()), {}};
  chord.right.x() = -chord.left.x();
  const auto add = [&](double x, double z) {
    if (x < chord.left.x()) chord.left = {x, z};
    if (x > chord.right.x()) chord.right = {x, z};
  };
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 &p = corners[i], &q = corners[(i + 1) % 3];
    if (p.y() == y) add(p.x(), p.z());
    if ((p.y() < y) == (q.y() < y)) continue;
    const double share = (y - p.y()) / (q.y() - p.y());
    add(p.x() + share * (q.x() - p.x()), p.z() + share * (q.z() - p.z()));
  }
  return chord;
}

// Some rows of a field, into which triangles are drawn.
class FieldRows {
 public:
  FieldRows(HeightField& field, int first, int end) : field_(field), first_(first), end_(end) {}

  // Draws a triangle. If the centre of a pixel is in the triangle or on its edge, the pixel gets at least the
  // triangle's height at this centre.
  void enter(const std::array<Vec3, 3>& corners) {
    const auto [low, high] = std::minmax({corners[0].y(), corners[1].y(), corners[2].y()});
    const int begin = std::max(first_, first_from(centre_at({0, high, 0}).y())),
              end = std::min(end_, end_after(centre_at({0, low, 0}).y()));
    for (int row = begin; row < end; ++row)
      enter_row(chord_at(corners, std::clamp(field_.to_mm(0, row + .5).y(), low, high)), row);
  }

 private:
  // Tolerance in pixels. It makes a centre on an edge belong to both triangles in spite of rounding.
  static constexpr double rounding = 1e-9;
  static int first_from(double centre) { return static_cast<int>(std::ceil(centre - rounding)); }
  static int end_after(double centre) { return static_cast<int>(std::floor(centre + rounding)) + 1; }

  // Returns the position of a point in pixels, measured from the centre of the first pixel.
  Vec2 centre_at(const Vec3& point) const { return field_.to_pixels(point) - Vec2(.5, .5); }

  void enter_row(const Chord& chord, int row) {
    const double left = centre_at({chord.left.x(), 0, 0}).x(), right = centre_at({chord.right.x(), 0, 0}).x();
    const double rise = chord.right.y() - chord.left.y();
    const int begin = std::max(0, first_from(left)), end = std::min(field_.z.width, end_after(right));
    for (int column = begin; column < end; ++column) {
      const double share = right > left ? std::clamp((column - left) / (right - left), 0., 1.) : 0;
      float& pixel = field_.z.at(column, row);
      const double above = chord.left.y() + share * rise - field_.box.min.z();
      pixel = std::max({pixel, 0.F, static_cast<float>(above)});
    }
  }

  HeightField& field_;
  int first_, end_;
};

}  // namespace

HeightField flat_height_field(const Box& box, const FieldSampling& sampling) {
  HeightField field;
  field.box = box;
  const Vec3 size = box.size();
  const double longer_mm = std::max(size.x(), size.y());
  const bool has_pitch = sampling.mm_per_pixel > 0;
  if (!(longer_mm > 0) || (!has_pitch && sampling.longer_side_px < 1)) return field;
  field.mm_per_pixel = has_pitch ? sampling.mm_per_pixel : longer_mm / sampling.longer_side_px;
  // Rounding may make a size slightly larger than a whole number of pixels. That must not add a pixel.
  constexpr double rounding_px = 1e-3;
  const auto pixels = [&](double mm) {
    const double count = mm / field.mm_per_pixel;
    return std::max(1., has_pitch ? std::ceil(count - rounding_px) : std::round(count));
  };
  const double width = pixels(size.x()), height = pixels(size.y());
  if (std::max(width, height) > RasterInput::most_pixels) return field;
  field.z = filled_image(static_cast<int>(width), static_cast<int>(height), 0.F);
  return field;
}

HeightField draw_height_field(const Solid& solid, int longer_side_px) {
  const auto front = std::span(solid.triangles).first(solid.front_triangles);
  HeightField field = flat_height_field(used_box(solid.points, front), {longer_side_px});
  if (field.z.empty()) return field;
  field.is_beside = filled_image(field.z.width, field.z.height, std::uint8_t{1});
  draw_bands(front_input(solid, field), 32, [&](const RowBand& band) {
    const std::size_t first = field.z.index(0, band.first_row);
    for (std::size_t i = 0; i < band.fragments.size(); ++i) {
      if (band.fragments[i].triangle == no_index) continue;
      field.is_beside[first + i] = 0;
      field.z[first + i] = std::max(0.F, band.fragments[i].z);
    }
  });
  return field;
}

HeightField measure_height_field(const Solid& solid, const FieldSampling& sampling) {
  const std::vector<Vec3f> stored = stored_points(solid);
  const auto corners_of = [&](std::size_t t) {
    const auto& [a, b, c] = solid.triangles[t];
    return std::array<Vec3, 3>{stored[a].cast<double>(), stored[b].cast<double>(), stored[c].cast<double>()};
  };
  const auto is_shown = [&](std::size_t t) {
    return !sampling.is_relief_alone || solid.regions.empty() || solid.regions[t] == Region::relief;
  };
  Box box;
  for (std::size_t t = 0; t < solid.front_triangles; ++t)
    if (is_shown(t))
      for (const Vec3& p : corners_of(t)) box.extend(p);
  HeightField field = flat_height_field(box, sampling);
  constexpr float beside = -1;  // below all heights, so that the relief's heights replace it
  if (sampling.is_relief_alone) std::ranges::fill(field.z.pixels, beside);
  const int least_rows = 32, most_bands = 64;
  const int rows = std::max(least_rows, (field.z.height + most_bands - 1) / most_bands);
  const int bands = (field.z.height + rows - 1) / rows;
  const auto draw_band = [&](std::size_t band) {
    const int first = static_cast<int>(band) * rows;
    FieldRows in_band(field, first, std::min(first + rows, field.z.height));
    for (std::size_t t = 0; t < solid.front_triangles; ++t)
      if (is_shown(t)) in_band.enter(corners_of(t));
  };
  parallel_for(static_cast<std::size_t>(bands), draw_band, 1);
  const auto ground = static_cast<float>(std::max(0., solid.ground_mm - box.min.z()));
  if (sampling.is_relief_alone) std::ranges::replace(field.z.pixels, beside, ground);
  return field;
}

}  // namespace relievo
