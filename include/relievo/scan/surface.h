// The surface that is visible in a view of a cloud: stages 1 to 6.
#pragma once

#include "relievo/core/progress.h"
#include "relievo/geometry/triangulation.h"
#include "relievo/scan/boundary.h"
#include "relievo/scan/curvature.h"
#include "relievo/scan/support_plane.h"
#include "relievo/scan/view.h"
#include "relievo/scan/visible.h"

namespace relievo {

// The visible points, and the hole fill points between them, in view coordinates. The points are in the order
// of a space-filling curve, so that neighbours in the view plane are close in memory and the order of the
// cloud has no influence.
struct Surface {
  std::vector<Vec3> points;             // R_view_model (p - centre)
  std::vector<Vec3f> normals;           // unit length, z > 0; (0, 0, 1) at hole fill points
  std::vector<Colour> colours;          // colours of the points; empty if the cloud has none
  std::vector<float> own_heights = {};  // see Cloud; empty if the cloud has none
  NormalisedCurvature curvature;
  Triangulation triangulation;  // without `neighbours`
  Boundary boundary;

  View view;
  Vec3 centre = Vec3::Zero();                  // centre of the cloud's box, in the model's frame
  std::optional<double> units_per_value = {};  // see Cloud
  double rho = 0;                              // sampling distance of the cloud
  double diagonal = 0;                         // L_d, the diagonal of the whole cloud's box
  std::size_t input_points = 0;
  std::size_t repeated_points = 0;  // points that were left out by without_repeated_points()
  std::size_t visible_points = 0;   // number of visible points; the rest of `points` are hole fill points
  std::size_t removed_points = 0;   // points that would be visible, but were removed as floating noise
  std::size_t crumbs = 0;           // number of small pieces that were left out
  // The table or background that was found, in the coordinates of `points`. Its points are left out unless
  // View::has_plane is true.
  std::optional<SupportPlane> plane = {};
  double measured_noise = 0;  // along the normals, in sampling distances; 0 if little
  double removed_noise = 0;   // the noise that the view asks to remove, or else the measured noise
  bool has_estimated_normals = false;
  bool has_flipped_normals = false;  // the cloud's normals pointed inwards

  // Returns the longer side of the points' box in the view plane; 0 without points.
  double longer_side() const { return Box::of(points).longer_side(); }

  // Returns the memory used, in bytes, colours not counted.
  std::size_t memory() const;
};

// Returns x and y of each point.
std::vector<Vec2> in_plane(std::span<const Vec3> points);

// Returns the surface of the part of the cloud that the view crops. Normals are estimated if the cloud has
// none, and turned if they point inwards. Noise is removed as the view asks for. Pieces of less than 0.5 % of
// the visible surface are left out as crumbs. If the view says so, a support plane and all points behind it
// are left out, too. Errors: kind geometry if a coordinate is not finite, normals do not match the points,
// fewer than 4 points are given or face the viewer, all are equal or on one line, or the visible points
// enclose no area; kind cancelled.
Result<Surface> find_surface(const Cloud& cloud, const View& view, Progress* progress = nullptr);

}  // namespace relievo
