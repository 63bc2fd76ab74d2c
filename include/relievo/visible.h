// Visible points (stage 3): what the viewer sees of the cloud, without leaks.
#pragma once

#include <span>
#include <vector>

#include "relievo/scan/cloud.h"
#include "relievo/scan/spacing.h"

namespace relievo {

struct VisibleOptions {
  double disc_radius = 2;  // of the disc by which a point covers what is behind it, in local spacings
  double depth_tolerance =
      2;  // depth behind the front that still counts as the front, in local spacings / n_z
  double twin_distance =
      0.01;  // of two points closer than this in the view plane the nearer one stays, in rho
  double filler_distance = 3;          // between a filler point and the nearest visible point, in rho
  std::size_t smallest_fragment = 32;  // connected sets of fewer visible points are strays and go
};

// Returns the numbers of the points that the viewer sees, ascending. `viewed` is in view coordinates with
// normals.
//
// A point is visible if it faces the viewer and lies within the tolerance of the front at its place, where
// the front is what the discs of all points that face the viewer cover: oriented by their normals, as wide as
// the local spacing, so that uneven density leaves no holes to look through. Strays neither show nor hide
// anything. After the paper's 3.2 (cells of 2 rho), which leaks and thins slopes.
std::vector<Index> visible_points(const Cloud& viewed, const Spacing& spacing,
                                  const VisibleOptions& options = {});

// Returns the numbers of points, ascending, that stand in for missing data: they face away from the viewer,
// and no visible point is near them in the view plane. There the model is, as its other side shows, but its
// front was not scanned; the relief goes on there, with nothing to show. At most about one in each square of
// side rho.
std::vector<Index> filler_points(const Cloud& viewed, const Spacing& spacing, std::span<const Index> visible,
                                 const VisibleOptions& options = {});

}  // namespace relievo
