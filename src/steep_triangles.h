// The last few triangles that are too steep, made flatter one by one.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "relievo/core/types.h"

namespace relievo {

// A height field over triangles of the plane.
struct SteepField {
  std::span<const Vec2> plane;
  std::span<const Triangle> triangles;
  std::span<const std::uint8_t> is_fixed;  // per point: keeps its height
};

enum class Rounding { none, single_precision };

// Slope (dz/dx, dz/dy) of a triangle; not finite where it has no area.
Vec2 triangle_slope(const SteepField& field, const Triangle& triangle, std::span<const double> heights);

// Steepest slope of the triangles; infinite where one that is not level has no area or is clockwise.
double steepest_of(const SteepField& field, std::span<const double> heights);

// Changes heights until no triangle is steeper than the limit: each that is moves its free corners by the
// least squares that make it flat enough, again and again as its neighbours do (projections onto convex
// sets), scaled in between where that hardly gets anywhere. With Rounding::single_precision every height
// stays a float. Returns whether it got there.
bool flatten(const SteepField& field, double max_slope, Rounding rounding, std::span<double> heights);

}  // namespace relievo
