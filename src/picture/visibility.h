// The point of a body that each pixel shows.
#pragma once

#include <optional>

#include "geometry/raster.h"
#include "picture/body.h"
#include "picture/screen_transform.h"
#include "relievo/core/image.h"

namespace relievo {

// A place on a triangle, by its corners' weights in 65535ths; the third corner has the rest.
struct VisiblePoint {
  Triangle corners = {no_index, no_index,
                      no_index};  // kept here: to look them up costs live pictures a third
  Index triangle = no_index;
  std::uint16_t first = 0, second = 0;
  float z = 0;  // towards the viewer, in pixels
  Part part = Part::nothing;

  // The mean of three values by these weights.
  template <typename T>
  T mean(const T& a, const T& b, const T& c) const {
    const float s = static_cast<float>(first) / 65535, t = static_cast<float>(second) / 65535;
    return s * a + t * b + (1 - s - t) * c;
  }
};

using VisibilityBuffer = Image<VisiblePoint>;

// The body's triangles in the picture's pixels. For height fields seen from above, heights are left out.
RasterInput raster_input(const DrawnBody& body, const ScreenTransform& transform);

// The place at (x, y) in the picture of one of the body's triangles.
VisiblePoint visible_point(const DrawnBody& body, const RasterInput& input, Index triangle,
                           const Vec3f& place);

// Overwrites the buffer with the places that are visible at the centres of the picture's pixels.
void draw_visibility(const DrawnBody& body, const RasterInput& input, VisibilityBuffer& buffer);

// Height above the ground at that point, in mm.
float height_mm(const DrawnBody& body, const VisiblePoint& seen);

// Keeps a buffer for as long as it shows the same points: while heights change, but not the plate's size,
// seen from above.
class CachedVisibility {
 public:
  const VisibilityBuffer& get(const DrawnBody& body, const ScreenTransform& transform);

 private:
  struct Key {
    ScreenTransform transform;
    double mm_per_place = 0;
    Vec2 corner;  // of the plate
    bool operator==(const Key&) const = default;
  };
  VisibilityBuffer buffer_;
  std::optional<Key> key_;
};

}  // namespace relievo
