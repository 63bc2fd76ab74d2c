#include "picture/draw_body.h"

#include "relievo/core/parallel.h"

namespace relievo {
namespace {

std::uint16_t to_65535ths(float weight) {
  return static_cast<std::uint16_t>(weight * 65535 + .5F);
}

bool hides_nothing(const DrawnBody& body, const ScreenTransform& transform) {
  return body.is_height_field && transform.is_front;
}

}  // namespace

RasterInput raster_input(const DrawnBody& body, const ScreenTransform& transform) {
  RasterInput input;
  input.triangles = body.triangles;
  input.width = transform.width;
  input.height = transform.height;
  input.points.resize(body.places.size() + body.box_corners.size());
  const bool is_flat = hides_nothing(body, transform);
  parallel_for(input.points.size(), [&](std::size_t i) {
    Vec3 point = body.point(static_cast<Index>(i));
    if (is_flat && i < body.places.size()) point.z() = 0;
    input.points[i] = transform.to_screen(point);
  });
  return input;
}

VisiblePoint visible_point(const DrawnBody& body, const RasterInput& input, Index triangle,
                           const Vec3f& place) {
  VisiblePoint seen{body.triangles[triangle], triangle, 0, 0, place.z(), body.parts.parts[triangle]};
  if (seen.part == Part::ground) return seen;
  const Vec3f weights =
      corner_weights(input, triangle, static_cast<double>(place.x()), static_cast<double>(place.y()));
  seen.first = to_65535ths(weights[0]);
  seen.second = to_65535ths(weights[1]);
  return seen;
}

void draw_visibility(const DrawnBody& body, const RasterInput& input, VisibilityBuffer& buffer) {
  buffer.resize(input.width, input.height);
  draw_bands(input, 16, [&](const RowBand& band) {
    const Fragment* fragment = band.fragments.pixels.data();
    for (int y = band.first_row; y < band.first_row + band.fragments.height; ++y)
      for (int x = 0; x < input.width; ++x, ++fragment)
        buffer.at(x, y) =
            fragment->triangle == no_index
                ? VisiblePoint{}
                : visible_point(body, input, fragment->triangle,
                                {static_cast<float>(x) + .5F, static_cast<float>(y) + .5F, fragment->z});
  });
}

float height_mm(const DrawnBody& body, const VisiblePoint& seen) {
  if (seen.part != Part::relief && seen.part != Part::curved) return 0;
  const auto& [a, b, c] = seen.corners;
  return body.mm_per_height * seen.mean(body.heights[a], body.heights[b], body.heights[c]);
}

const VisibilityBuffer& CachedVisibility::get(const DrawnBody& body, const ScreenTransform& transform) {
  const Key key{transform, body.mm_per_place, body.front.min.head<2>()};
  if (hides_nothing(body, transform) && key_ == key) return buffer_;
  draw_visibility(body, raster_input(body, transform), buffer_);
  key_ = key;
  return buffer_;
}

}  // namespace relievo
