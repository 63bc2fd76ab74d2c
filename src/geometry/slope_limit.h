// Limits the slopes of a height field over triangles of the plane.
#pragma once

#include <cstdint>
#include <span>

#include "relievo/core/types.h"

namespace relievo {

// A triangle mesh in the plane, over which heights are given.
struct PlaneMesh {
  std::span<const Vec2> plane;
  std::span<const Triangle> triangles;
  std::span<const std::uint8_t> is_fixed;  // per point: its height must not change
};

// Whether heights are rounded to floats, as files store them.
enum class Rounding { none, single_precision };

// Returns the slope (dz/dx, dz/dy) of a triangle. It is not finite if the triangle has no area.
Vec2 triangle_slope(const PlaneMesh& field, const Triangle& triangle, std::span<const double> heights);

// Returns the largest slope of all triangles, as rise over run; 0 without triangles. It is infinite if a
// triangle has no area or is clockwise, unless that triangle is level.
double steepest_of(const PlaneMesh& field, std::span<const double> heights);

// Changes heights until no triangle is steeper than `max_slope`, by projections onto convex sets: the free corners of
// a triangle that is too steep are moved so that it is flat enough and the sum of squares of the moves is least. A
// projection changes neighbouring triangles, so projections are repeated. This is meant for a few steep triangles.
// With Rounding::single_precision every height is representable as a float. Returns whether it succeeded; if not,
// some triangles are still too steep.
bool limit_slopes(const PlaneMesh& field, double max_slope, Rounding rounding, std::span<double> heights);

}  // namespace relievo
