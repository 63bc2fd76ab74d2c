// Limits that decide which points of a scan are visible and which holes and small pieces are closed or left
// out. The surface of all points and the coarse one of a turned model share these limits.
#pragma once

namespace relievo {

struct ScanLimits {
  // Radius, in local spacings, of the disc with which a point hides what is behind it.
  static constexpr double disc_radius = 2;
  // Limits of the local spacing, in rho. Near coincident points the spacing is almost 0, so that the surface
  // would have gaps there. A lone point far from all others must not hide an area as large as its spacing.
  static constexpr double least_spacing = .25, largest_spacing = 4;
  // A point is visible if it lies behind the front by at most this, in local spacings / n_z.
  static constexpr double depth_tolerance = 2;
  static constexpr double least_facing = .1;  // least n_z in the tolerance, for surfaces seen edge on
  // Hole fill points are at least this far from the nearest visible point in the view plane, in rho.
  static constexpr double hole_fill_distance = 3;
  // Radius in rho. A hole inside the silhouette is closed if no larger empty circle fits into it.
  static constexpr double largest_hole = 5;
  static constexpr double crumb_share = .005;  // share of the visible surface; smaller pieces are crumbs
};

}  // namespace relievo
