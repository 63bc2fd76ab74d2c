// Iterates over the triangles inside the relief and over their sides, and finds depth jumps: edges of the triangulation
// whose ends belong to unconnected parts of the surface.
#pragma once

#include <ranges>
#include <vector>

#include "relievo/scan/surface.h"

namespace relievo {

// Returns a range of the triangles inside the relief. It refers to `surface`, which must outlive it.
inline auto triangles_inside(const Surface& surface) {
  return std::views::iota(std::size_t{0}, surface.triangulation.triangles.size()) |
         std::views::filter([&](std::size_t t) { return surface.boundary.is_inside[t] != 0; }) |
         std::views::transform([&](std::size_t t) { return surface.triangulation.triangles[t]; });
}

// Calls f(a, b) for the sides of the triangles inside the relief; once per triangle, so twice for a shared side.
template <typename F>
void each_side_inside(const Surface& surface, F&& f) {
  for (const Triangle corners : triangles_inside(surface))
    for (std::size_t k = 0; k < 3; ++k) f(corners[k], corners[(k + 1) % 3]);
}

// Returns whether there is a depth jump between two neighbouring points: their depths differ by more than 3
// rho plus twice the difference that their normals explain.
bool is_jump(const Surface& surface, Index a, Index b);

// Returns for each triangle whether it is inside the relief and has an edge across a depth jump.
std::vector<std::uint8_t> jump_triangles(const Surface& surface);

}  // namespace relievo
