// Visible points (stage 3): which points of a scattered cloud are not hidden by others, and which points
// stand in for a front that was not scanned.
#pragma once

#include <span>
#include <vector>

#include "relievo/scan/cloud.h"
#include "relievo/scan/spacing.h"

namespace relievo {

struct VisibleOptions {
  // Radius, in local spacings, of the disc with which a point hides what is behind it.
  double disc_radius = 2;
  // A point is visible if it lies behind the front by at most this, in local spacings / n_z.
  double depth_tolerance = 2;
  // Among points closer to each other than this in the view plane, in rho, only the one nearest to the viewer is
  // kept.
  double coincidence_distance = 0.01;
  // Hole fill points are at least this far from the nearest visible point in the view plane, in rho.
  double hole_fill_distance = 3;
  // Connected sets of fewer visible points are taken for floating noise and removed.
  std::size_t smallest_fragment = 32;
};

// Returns the numbers of the visible points, ascending. `viewed` is in view coordinates and has normals;
// without normals the result is empty.
//
// Every point that faces the viewer is drawn as a disc into a depth buffer, oriented by its normal and as
// wide as the local spacing, so that there are no gaps to look through even if the density varies. A point is
// visible if it faces the viewer and is not behind the buffer's depth by more than the tolerance. Small
// connected sets neither show nor hide anything. This replaces the cells of 2 rho of the paper's section 3.2,
// through which hidden points leak and which lose points on slopes.
std::vector<Index> visible_points(const Cloud& viewed, const Spacing& spacing,
                                  const VisibleOptions& options = {});

struct VisiblePoints {
  std::vector<Index> points;
  std::size_t removed = 0;  // number of points that would be visible, but are taken for floating noise
};

// Returns the same points, and how many were removed.
VisiblePoints find_visible(const Cloud& viewed, const Spacing& spacing, const VisibleOptions& options = {});

// Returns the numbers of points, ascending, that stand in for missing data: points that face away from the
// viewer and have no visible point near them in the view plane. The scan shows the back of the model there
// but not its front; with these points the relief has no hole there, only a flat spot. Any two of them are at
// least 0.7 rho apart.
std::vector<Index> hole_fill_points(const Cloud& viewed, const Spacing& spacing,
                                    std::span<const Index> visible, const VisibleOptions& options = {});

}  // namespace relievo
