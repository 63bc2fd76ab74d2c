// Makes the triangles of a relief on a rectangular plate. They do not depend on the heights, so all frames of
// a model (see frame.h) have the same triangles.
#pragma once

#include <vector>

#include "picture/body.h"
#include "picture/draw_body.h"
#include "relievo/picture/render.h"

namespace relievo {

// The triangles of a relief on a rectangular plate. They refer to the surface's points and, with the next
// higher indices, to the plate's eight corners.
struct PlateMesh {
  std::vector<Triangle> triangles;
  PlateParts parts;
  std::vector<Vec2> places;      // positions of the surface's points from `middle`, in the surface's units
  Vec2 half = Vec2::Zero();      // half the size of the points' box
  Vec2f middle = Vec2f::Zero();  // middle of the points' box
};

PlateMesh plate_mesh(const Surface& surface);

// Returns the parts of a plate whose relief changes. In the solid `level`, all heights of the relief are zero.
PlateParts parts_of_frames(const Solid& level, const Surface& surface);

// Returns the body of a frame on its plate. The body refers to the mesh and to `shown`.
DrawnBody frame_body(const PlateMesh& mesh, const Shown& shown, const RenderOptions& options);

// Returns the rotation from the body to the screen.
Mat3 rotation_of(const Camera& camera);

// Returns the transform that fits a box of the given size, centred at the origin, into the picture after
// the camera has rotated and moved it.
ScreenTransform camera_transform(const Vec3& size, const RenderOptions& options);

// Returns the transform that fits the plate into the picture after the camera has rotated and moved it.
ScreenTransform frame_transform(const PlateMesh& mesh, const RenderOptions& options);

}  // namespace relievo
