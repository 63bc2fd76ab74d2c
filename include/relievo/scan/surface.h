// What a view shows of a cloud, ready to be made a relief: stages 1 to 6 in a row.
#pragma once

#include "relievo/boundary.h"
#include "relievo/core/progress.h"
#include "relievo/geometry/triangulation.h"
#include "relievo/relief/layers.h"
#include "relievo/scan/curvature.h"
#include "relievo/view.h"
#include "relievo/visible.h"

namespace relievo {

struct SurfaceOptions {
  VisibleOptions visible;
  CurvatureOptions curvature;
  BoundaryOptions boundary;
};

// The visible points and the fillers between them, in view coordinates, along a space-filling curve:
// neighbours in space are neighbours in memory, and the order of the cloud does not matter.
struct Surface {
  std::vector<Vec3> points;     // relative to `centre`, rotated
  std::vector<Vec3f> normals;   // unit length, z > 0; (0, 0, 1) at fillers
  std::vector<Colour> colours;  // of the points; empty if the cloud has none
  NormalisedCurvature curvature;
  std::vector<PointLayers> layers;
  Triangulation triangulation;  // its `neighbours` are not kept
  Boundary boundary;

  View view;
  Vec3 centre = Vec3::Zero();  // of the cloud's box, in the model's frame
  double rho = 0;              // sampling distance of the cloud
  double diagonal = 0;         // L_d, of the whole cloud's box
  std::size_t input_points = 0;
  std::size_t visible_points = 0;  // of them; the rest of `points` are fillers
  bool has_estimated_normals = false;
  bool has_flipped_normals = false;  // the file's normals pointed inwards

  // Bytes held.
  std::size_t memory() const;
};

// Returns x and y of each point.
std::vector<Vec2> in_plane(std::span<const Vec3> points);

// Returns the surface. Normals are estimated if the cloud has none, and turned if they point inwards.
// Errors: kind geometry if a coordinate is not finite, normals do not match the points, fewer than 4 points
// are given or face the viewer, all are equal or on one line, or the visible points enclose no area; kind
// cancelled.
Result<Surface> find_surface(const Cloud& cloud, const View& view, const SurfaceOptions& options = {},
                             Progress* progress = nullptr);

}  // namespace relievo
