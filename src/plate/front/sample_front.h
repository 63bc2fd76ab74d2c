// Samples the smooth surface of a front with well-shaped triangles.
#pragma once

#include <span>
#include <vector>

#include "relievo/core/image.h"
#include "relievo/core/progress.h"
#include "relievo/core/types.h"
#include "relievo/geometry/triangulation.h"
#include "relievo/plate/solid.h"

namespace relievo {

struct FrontSampling {
  // Largest distance between samples, > 0, except where the surface is nearly plane.
  double resolution_mm = .15;
  // Largest angle between neighbouring facets, in radians, where the curvature is even. Where the surface is
  // flatter, samples are up to 8 steps of `resolution_mm` apart. Where it is more curved, they are half a
  // step apart.
  double facet_angle = .034;
};

// Returns a front with the same hull. Its points lie on the smooth surface through the given front, most of
// them on a square grid. `is_smooth` marks the smooth triangles; the other triangles stay plane. Creases are
// the edges between smooth triangles and others. Near creases the given front's triangles are kept, and
// divided until their edges are about as long as the grid step. The highest and the lowest point are kept.
// Errors: kind cancelled.
Result<HeightFieldMesh> sample_front(const HeightFieldMesh& front, std::span<const std::uint8_t> is_smooth,
                                     const FrontSampling& options, const Progress* progress = nullptr);

struct SampleSquare {
  int x = 0, y = 0;           // column and row of the upper left cell
  int side = 1;               // 1, 2, 4 or 8 cells
  bool is_quartered = false;  // a square of one cell that gets four samples
};

// The number of cells along a side of the largest square. The grid's width and height are multiples of it.
constexpr int largest_square = 8;

// Returns squares that cover the grid cells whose slope is not NaN. Across a square of several cells the
// surface turns by at most about `facet_angle`, in radians. A single cell is quartered if the surface turns
// by more than this angle across it and its curvature is even. Apart from quartered cells, neighbouring
// squares differ in size by at most a factor of two.
std::vector<SampleSquare> sample_squares(const Image<Vec2f>& slopes, float facet_angle);

// Turns diagonals of a Delaunay triangulation whose points lie on a grid. In each rectangle, both diagonals
// are Delaunay; an arbitrary choice would make ridges jagged. Chooses the diagonal along which the slope
// changes less, unless the slope of a corner is NaN. Only the triangles are updated; the mesh's neighbours
// become invalid.
void turn_diagonals(std::span<const Vec2> points, std::span<const Vec2f> slopes, Triangulation& mesh);

}  // namespace relievo
