// Defines the triangles of a body, with the data for rendering. A body is a finished solid, or a frame on its
// plate.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "relievo/core/types.h"
#include "relievo/plate/solid.h"

namespace relievo {

struct SurfaceDetail;

// The part of the body to which a triangle belongs. It determines the shading.
enum class Part : std::uint8_t {
  nothing,
  relief,  // shaded by the normals of its points, or flat if it is level
  ground,  // level, at height 0
  curved,  // the rest of the front, such as a base or a rim; shaded by the normals of its corners
  wall     // sides and bottom; shaded like `curved`, but without cast shadows
};

// The part of each triangle. Triangles that are not shaded by the normals of their points have corner
// normals in addition.
struct PlateParts {
  std::vector<Part> parts;                           // part of each triangle
  std::vector<Index> corners_at;                     // per triangle: index into corner_normals, or no_index
  std::vector<std::array<Vec3f, 3>> corner_normals;  // unit length
  std::size_t front_triangles = 0;                   // number of front triangles, which come first
  bool has_curved_ground = false;                    // whether the ground lies on a curved base or is bent
};

// Returns the parts of a solid. Corner normals are smoothed across an edge if its two triangles belong to the
// same part and meet at less than 20 degrees.
PlateParts plate_parts(const Solid& solid);

// A body to draw. x and y are measured from the middle of its box, and z is measured from the ground.
// Triangles refer to points by index: first the points with heights, then `box_corners`. A DrawnBody does not
// own its arrays.
struct DrawnBody {
  std::span<const Triangle> triangles;
  const PlateParts& parts;
  std::span<const Vec2> places;  // in units of mm_per_place mm
  double mm_per_place = 1;
  std::span<const float> heights;  // in units of mm_per_height mm
  float mm_per_height = 1;
  std::span<const Vec3f> normals;         // normals of the relief's points, unit length
  float stretch = 1;                      // factor by which `normals` are made steeper
  const SurfaceDetail* detail = nullptr;  // detail between the points, added with `gains`; see Shown
  std::span<const float> gains = {};
  std::span<const float> tint = {};  // see Shown
  Vec2f middle = Vec2f::Zero();      // middle of the surface's points, in the coordinates of `detail`
  std::vector<Vec3> box_corners = {};
  Box front = {};  // box of the front's points, in mm
  // Whether no point of the front hides another one in the view from above. If so, rendering this view
  // does not need the heights.
  bool is_height_field = false;
  bool is_rectangle = false;  // whether the front covers its box

  Vec3 point(Index i) const {
    if (i >= places.size()) return box_corners[i - places.size()];
    const Vec2 xy = mm_per_place * places[i];
    return {xy.x(), xy.y(), static_cast<double>(mm_per_height * heights[i])};
  }
  float lowest_mm() const { return static_cast<float>(front.min.z()); }
  float span_mm() const { return static_cast<float>(front.size().z()); }
};

// A finished solid for rendering.
class SolidBody {
 public:
  explicit SolidBody(const Solid& solid);

  // Returns the body, which is valid as long as this object and the solid exist.
  DrawnBody body() const;

 private:
  const Solid& solid_;
  PlateParts parts_;
  std::vector<Vec2> places_;
  std::vector<float> heights_;
  std::vector<Vec3f> normals_;
};

// Returns a unit normal for each point of the relief: the mean normal of its triangles, weighted by their
// areas. All other points get zero.
std::vector<Vec3f> relief_normals(const Solid& solid);

}  // namespace relievo
