// Finds the visible surface of a cloud in a view (stages 1 to 6).
#pragma once

#include "relievo/core/progress.h"
#include "relievo/geometry/triangulation.h"
#include "relievo/scan/boundary.h"
#include "relievo/scan/curvature.h"
#include "relievo/scan/support_plane.h"
#include "relievo/scan/view.h"
#include "relievo/scan/visible.h"

namespace relievo {

// The visible points, and the hole-fill points between them, in view coordinates. They are in the order of a
// space-filling curve, so that neighbours in the view plane are close in memory and the order of the cloud
// has no influence.
struct Surface {
  std::vector<Vec3> points;             // R_view_model (p - centre) for points p of the cloud
  std::vector<Vec3f> normals;           // unit vectors with z > 0; (0, 0, 1) at hole-fill points
  std::vector<Colour> colours;          // colours of the points; empty if the cloud has none
  std::vector<float> own_heights = {};  // see Cloud; empty if the cloud has none
  NormalisedCurvature curvature;
  Triangulation triangulation;  // its `neighbours` are empty
  Boundary boundary;

  View view;
  Vec3 centre = Vec3::Zero();                  // centre of the cloud's bounding box, in the model's axes
  std::optional<double> units_per_value = {};  // see Cloud
  double rho = 0;                              // sampling distance of the cloud
  double diagonal = 0;                         // L_d, the diagonal of the whole cloud's bounding box
  std::size_t input_points = 0;
  std::size_t repeated_points = 0;  // number of points left out by without_repeated_points()
  std::size_t visible_points = 0;   // number of visible points; the other `points` are hole-fill points
  std::size_t removed_points = 0;   // number of visible points that were removed as floating noise
  std::size_t crumbs = 0;           // number of small parts that were left out
  // The table or background, in the coordinates of `points`; empty if none was found. Its points are left out
  // if View::has_plane is false.
  std::optional<SupportPlane> plane = {};
  double measured_noise = 0;  // noise along the normals (standard deviation), in rho; 0 if it is small
  double removed_noise = 0;   // noise that was removed, in rho: that of View::denoise, or the measured noise
  bool has_estimated_normals = false;
  bool has_flipped_normals = false;  // whether the cloud's normals pointed inwards

  // Returns the longer side of the points' bounding box in the view plane; 0 without points.
  double longer_side() const { return Box::of(points).longer_side(); }

  // Returns the number of bytes of memory in use, without colours.
  std::size_t memory() const;
};

// Returns the x and y of each point.
std::vector<Vec2> in_plane(std::span<const Vec3> points);

// Returns the surface of the part of the cloud inside the view's crop. Normals are estimated if there are
// none, and reversed if they point inwards. Noise is removed as the view specifies. Parts of less than 0.5 %
// of the visible surface are left out as crumbs. If View::has_plane is false, a support plane and all points
// behind it are left out, too. Errors: kind geometry if a coordinate is not finite, if the number of normals
// differs from the number of points, if fewer than 4 points are given or face the viewer, if all points are
// equal or collinear, or if the visible points enclose no area; kind cancelled.
Result<Surface> find_surface(const Cloud& cloud, const View& view, Progress* progress = nullptr);

}  // namespace relievo
