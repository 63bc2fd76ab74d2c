// Defines limits that decide which points of a scan are visible, which holes are closed, and which small parts are
// removed. They apply to the full surface and to the coarse one that is shown while the model is turned.
#pragma once

namespace relievo {

struct ScanLimits {
  // Radius, in local spacings, of the disc with which a point hides points behind it.
  static constexpr double disc_radius = 2;
  // Limits of the local spacing, in rho. Near coincident points the spacing is almost 0, so that the surface
  // would have gaps there. At an isolated point the spacing is so large that the point would hide too large
  // an area.
  static constexpr double least_spacing = .25, largest_spacing = 4;
  // A point is visible if it is at most this far behind the surface in front. The unit is the local spacing,
  // divided by n_z.
  static constexpr double depth_tolerance = 2;
  // The least divisor for the unit of depth_tolerance. It replaces smaller n_z, as on surfaces seen edge-on.
  static constexpr double least_facing = .1;
  // Hole-fill points are at least this far from the nearest visible point in the view plane, in rho.
  static constexpr double hole_fill_distance = 3;
  // Radius in rho. A hole inside the silhouette is closed if no larger empty circle fits into it.
  static constexpr double largest_hole = 5;
  static constexpr double crumb_share = .005;  // share of the visible surface; smaller parts are crumbs
};

}  // namespace relievo
