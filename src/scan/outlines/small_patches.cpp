#include "scan/jumps.h"
#include "scan/outlines/outline_points.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "core/disjoint_sets.h"
#include "core/lists.h"
#include "scan/outlines/outlines.h"

namespace relievo {
namespace {

// Patches with fewer points are small. The rows of points extend 3 rho inwards from each side of a patch, so
// in a small patch they would replace all points.
constexpr std::size_t least_patch = 60;
// A small patch is removed if it is the rear side of at least this share of the depth jumps around it.
constexpr double least_behind = .7;

// The longest edge that connects points, in rho (sampling distances). Longer edges cross regions without points.
constexpr double connection_length = 3;

// `jumps` counts the jumps and gaps between points of a patch and other points. `behind` counts those jumps
// and gaps at which the patch is behind.
struct Rim {
  std::uint32_t jumps = 0, behind = 0;
};

// Returns for each point whether it is kept.
std::vector<std::uint8_t> points_to_keep(const Surface& surface) {
  DisjointSets patches(surface.points.size());
  std::vector<std::array<Index, 2>> jumps;
  each_side_inside(surface, [&](Index a, Index b) {
    const double length = (surface.points[a] - surface.points[b]).head<2>().norm();
    if (is_occlusion(surface, a, b) || length > connection_length * surface.rho)
      jumps.push_back({a, b});
    else
      patches.join(a, b);
  });
  std::vector<Rim> rims(surface.points.size());
  for (const auto& [a, b] : jumps) {
    const bool is_a_behind = surface.points[a].z() < surface.points[b].z();
    ++rims[patches.find(a)].jumps, ++rims[patches.find(b)].jumps;
    ++rims[patches.find(is_a_behind ? a : b)].behind;
  }
  std::vector<std::uint8_t> is_kept(surface.points.size());
  for (Index i = 0; i < is_kept.size(); ++i) {
    const Rim& rim = rims[patches.find(i)];
    is_kept[i] = patches.size_of(i) >= least_patch || rim.jumps == 0 || rim.behind < least_behind * rim.jumps;
  }
  return is_kept;
}

}  // namespace

bool drop_small_patches(Surface& surface, PointMeasures& measures) {
  const std::vector<std::uint8_t> is_kept = points_to_keep(surface);
  const auto kept = std::ranges::count(is_kept, std::uint8_t{1});
  if (kept == std::ssize(is_kept) || kept < 4) return false;
  const auto stays = [&](std::size_t i) { return is_kept[i] != 0; };
  keep_where(surface.points, stays);
  keep_where(surface.normals, stays);
  keep_where(surface.colours, stays);
  keep_where(surface.own_heights, stays);
  keep_where(measures.k, stays);
  keep_where(measures.spacing, stays);
  return true;
}

}  // namespace relievo
