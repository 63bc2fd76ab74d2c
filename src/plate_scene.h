// A plate as triangles in a picture: what a live picture is drawn from.
#pragma once

#include <algorithm>
#include <vector>

#include "pixel_map.h"
#include "relievo/picture/render.h"

namespace relievo {

// The plate's triangles; heights and corners move, these do not.
struct Topology {
  std::vector<Triangle> triangles;
  std::vector<Part> parts;   // per triangle
  std::vector<Vec2> places;  // of the surface's points from the middle, in its units
  Vec2 half = Vec2::Zero();  // half the size of their box
};

Topology topology_of(const Surface& surface);

// Where the plate lies in the picture: pixel = middle + pixels_per_mm * turn * (place - pan), y downwards.
struct Placement {
  static constexpr double farthest = 100000;  // pixels from the picture's middle, what a raster can take

  int width = 0, height = 0;
  double pixels_per_mm = 1;
  Mat3 turn = Mat3::Identity();
  Vec3 pan = Vec3::Zero();
  bool is_front = true;

  Vec3 to_picture(const Vec3& place) const {
    const Vec3 p = pixels_per_mm * (turn * (place - pan));
    return {width / 2.0 + std::clamp(p.x(), -farthest, farthest),
            height / 2.0 - std::clamp(p.y(), -farthest, farthest), p.z()};
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

Placement placement_of(const Topology& topology, const RenderOptions& options, int samples_per_side);

// What all pixels of a picture share.
struct PlateScene {
  const Topology& topology;
  const Shown& shown;
  const RenderOptions& options;
  float z_mm = 1;                    // per unit of the heights
  float lowest_mm = 0, span_mm = 0;  // of the heights, ground included
};

PlateScene scene_of(const Topology& topology, const Shown& shown, const RenderOptions& options);

// The triangles in the picture. Seen from the front, heights make no difference and are left out.
Drawing raster_scene(const PlateScene& scene, const Placement& placement);

// Of a triangle of the plate's sides or bottom; `first_corner` is the number of the first of the plate's
// eight.
Vec3f wall_normal(const Triangle& corners, std::size_t first_corner);

}  // namespace relievo
