// Finds the boundary (stage 5): the triangles that belong to the relief, and the points where the relief
// meets the base.
#pragma once

#include <span>
#include <vector>

#include "relievo/geometry/triangulation.h"

namespace relievo {

enum class WallSide : std::uint8_t { none, front, back };

struct Boundary {
  std::vector<std::uint8_t> is_inside;    // per triangle: whether it belongs to the relief
  std::vector<std::uint8_t> is_boundary;  // per point: whether it is in P_b (silhouette and rims of holes)
  // The distance of each point from the nearest point of P_b in the view plane: `dist` of equation (7).
  std::vector<float> distance;
  // For each point: whether it is on the front edge or the back edge of the wall at a depth jump, or on no
  // wall. Empty if there are no walls.
  std::vector<WallSide> wall_side;

  bool is_across_wall(Index a, Index b) const {
    return !wall_side.empty() && wall_side[a] != WallSide::none && wall_side[b] != WallSide::none &&
           wall_side[a] != wall_side[b];
  }
};

// Returns for each triangle whether it belongs to the relief. The arguments are points in the view plane,
// their Delaunay triangulation, and their sampling distance rho.
//
// A triangle is outside if the radius of its circumcircle exceeds 3 rho, because there are no points inside
// that circle. A triangle of a narrow hole is not outside. A narrow hole is a connected set of triangles with
// radii from 3 to 5 rho that does not touch the hull. If the local spacing of all three corners exceeds 2
// rho, the scan is sparse there, and the local spacing replaces rho. `spacing` is Spacing::local of each
// point, for clouds of uneven density. For other clouds, `spacing` must be empty, because local spacings
// would close gaps beside surfaces that are seen edge-on.
std::vector<std::uint8_t> inside_triangles(std::span<const Vec2> points, const Triangulation& triangulation,
                                           double rho, std::span<const float> spacing = {});

// Returns the boundary of points of even density. Boundary points are the corners of outside triangles, the
// points on the hull, and the points that are in no inside triangle.
Boundary find_boundary(std::span<const Vec2> points, const Triangulation& triangulation, double rho);

// Returns for each of `points` points whether it is a corner of an outside triangle, on the hull, or in no
// triangle.
std::vector<std::uint8_t> boundary_points(std::size_t points, const Triangulation& triangulation,
                                          std::span<const std::uint8_t> is_inside);

// Returns for each point its distance from the nearest boundary point; infinity if there is none.
std::vector<float> distances_to(std::span<const Vec2> points, const std::vector<std::uint8_t>& is_boundary);

}  // namespace relievo
