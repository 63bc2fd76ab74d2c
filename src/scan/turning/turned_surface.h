// Makes surfaces of about 18,000 points, from which reliefs are made while the user turns the model. Tested by
// tests/scan/turning_test.cpp.
#pragma once

#include "relievo/core/progress.h"
#include "relievo/scan/surface.h"
#include "scan/turning/front_cells.h"

namespace relievo {

class MeasuredCloud;

// The points of a scan that are drawn: at most 600,000, selected evenly from larger scans.
struct TurningScan {
  explicit TurningScan(const MeasuredCloud& measured);

  std::vector<FrontPoint> points;
  bool do_normals_face_viewer = false;  // true if signs are unknown; each normal is then turned to the viewer
  Vec3 centre = Vec3::Zero();           // see Surface::centre
  double rho = 0, diagonal = 0;

  // `surface` is a surface of this scan that has a support plane. Returns the scan without the points on this
  // plane and the points behind it.
  TurningScan without_plane(const Surface& surface) const;
};

struct TurnedSurface {
  Surface surface;   // its points are the centres of cells
  FrontCells front;  // drawn from all points of the scan
};

// Returns a surface of about `points` points in the view: one point for every few cells, more along
// silhouettes and depth jumps. Errors: kind geometry if the view shows no area; kind cancelled.
Result<TurnedSurface> turned_surface(const TurningScan& scan, const View& view, std::size_t points,
                                     Progress* progress = nullptr);

}  // namespace relievo
