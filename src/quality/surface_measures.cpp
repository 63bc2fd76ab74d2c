#include "quality/surface_measures.h"

#include <algorithm>
#include <cmath>

#include "core/angle.h"
#include "core/quantile.h"
#include "geometry/edges.h"
#include "geometry/plane.h"
#include "scan/jumps.h"

namespace relievo {
namespace {

constexpr std::size_t half_window = 12;  // half the width of the moving mean, in triangles
// Largest angle between the model's normals at the two ends of an edge.
constexpr double smooth_turn_deg = 10;
constexpr double quantile_of_facets = .99;

Vec2 gradient(const Surface& surface, std::span<const double> heights, Index t) {
  const auto& [a, b, c] = surface.triangulation.triangles[t];
  const auto at = [&](Index i) -> Vec2 { return surface.points[i].head<2>(); };
  const Vec2 u = at(b) - at(a), v = at(c) - at(a);
  const double p = heights[b] - heights[a], q = heights[c] - heights[a], twice_area = cross(u, v);
  return Vec2(p * v.y() - q * u.y(), q * u.x() - p * v.x()) / twice_area;
}

// Sums the squared differences between the angles along a chain and their moving means.
struct Residuals {
  double sum = 0;
  std::size_t count = 0;

  void add(const std::vector<double>& values) {
    const std::size_t n = values.size();
    if (n <= 2 * half_window) return;
    for (std::size_t i = half_window; i + half_window < n; ++i) {
      double mean = 0;
      for (std::size_t k = i - half_window; k <= i + half_window; ++k) mean += values[k];
      const double rest = values[i] - mean / (2 * half_window + 1);
      sum += rest * rest, ++count;
    }
  }
  double deviation() const { return count > 0 ? std::sqrt(sum / static_cast<double>(count)) : 0; }
};

// Connects triangle sides on an outline into chains.
template <typename Rim>
std::vector<std::vector<Rim>> chains_of(const std::vector<Rim>& rims, std::size_t points) {
  std::vector<Index> next(points, no_index);
  std::vector<std::uint8_t> is_reached(points), is_used(rims.size());
  for (Index r = 0; r < rims.size(); ++r) next[rims[r].from] = r, is_reached[rims[r].to] = 1;
  std::vector<std::vector<Rim>> chains;
  const auto follow = [&](Index r) {
    std::vector<Rim> chain;
    for (; r != no_index && !is_used[r]; r = next[rims[r].to]) is_used[r] = 1, chain.push_back(rims[r]);
    if (!chain.empty()) chains.push_back(std::move(chain));
  };
  for (Index r = 0; r < rims.size(); ++r)
    if (!is_reached[rims[r].from]) follow(r);
  for (Index r = 0; r < rims.size(); ++r) follow(r);
  return chains;
}

}  // namespace

SurfaceMeasures::SurfaceMeasures(const Surface& surface) : surface_(surface) {
  find_outlines();
  find_pairs();
}

// Finds those sides of triangles that are on outlines. A side is on the silhouette if both ends are. It is at
// a jump if both ends are on the same edge of the jump's wall. The triangle's third corner must not be on the
// outline.
void SurfaceMeasures::find_outlines() {
  const Boundary& boundary = surface_.boundary;
  std::vector<Rim> silhouette, front, back;
  const auto is_on = [&](Index i, WallSide side) {
    return !boundary.wall_side.empty() && boundary.wall_side[i] == side;
  };
  for (Index t = 0; t < surface_.triangulation.triangles.size(); ++t) {
    if (!boundary.is_inside[t]) continue;
    const Triangle& corners = surface_.triangulation.triangles[t];
    for (std::size_t k = 0; k < 3; ++k) {
      const Index a = corners[k], b = corners[(k + 1) % 3], apex = corners[(k + 2) % 3];
      if (boundary.is_boundary[a] && boundary.is_boundary[b] && !boundary.is_boundary[apex])
        silhouette.push_back({a, b, t});
      if (!is_on(apex, WallSide::none)) continue;
      if (is_on(a, WallSide::front) && is_on(b, WallSide::front)) front.push_back({a, b, t});
      if (is_on(a, WallSide::back) && is_on(b, WallSide::back)) back.push_back({a, b, t});
    }
  }
  silhouettes_ = chains_of(silhouette, surface_.points.size());
  jumps_ = chains_of(front, surface_.points.size());
  for (Chain& chain : chains_of(back, surface_.points.size())) jumps_.push_back(std::move(chain));
}

void SurfaceMeasures::find_pairs() {
  const double least_cosine = std::cos(to_radians(smooth_turn_deg));
  const auto is_smooth = [&](const TriangleSide& side) {
    const Index a = side.low(), b = side.high();
    const bool is_turning = static_cast<double>(surface_.normals[a].dot(surface_.normals[b])) < least_cosine;
    return surface_.boundary.is_inside[side.triangle] && !is_turning &&
           !surface_.boundary.is_across_wall(a, b);
  };
  each_edge(surface_.triangulation.triangles, is_smooth, [&](std::span<const TriangleSide> sides) {
    if (sides.size() == 2) smooth_pairs_.push_back({sides[0].triangle, sides[1].triangle});
  });
}

SurfaceMeasures::Fray SurfaceMeasures::fray(std::span<const double> heights) const {
  const auto deviation = [&](const std::vector<Chain>& chains) {
    Residuals residuals;
    for (const Chain& chain : chains) {
      std::vector<double> across, along;
      for (const Rim& rim : chain) {
        const Vec2 side = (surface_.points[rim.to] - surface_.points[rim.from]).head<2>().normalized();
        const Vec2 slope = gradient(surface_, heights, rim.triangle);
        across.push_back(to_degrees(std::atan(cross(side, slope))));
        along.push_back(to_degrees(std::atan(side.dot(slope))));
      }
      residuals.add(across);
      residuals.add(along);
    }
    // A triangle has two values, across and along, which are components of one angle. So the sum of squares is divided
    // by the number of triangles, half the number of values; hence the factor sqrt(2).
    return std::sqrt(2.) * residuals.deviation();
  };
  return {deviation(silhouettes_), deviation(jumps_)};
}

double SurfaceMeasures::facet_angle_deg(std::span<const double> heights) const {
  if (smooth_pairs_.empty()) return 0;
  const auto normal = [&](Index t) {
    const Vec2 g = gradient(surface_, heights, t);
    return Vec3(-g.x(), -g.y(), 1).normalized();
  };
  std::vector<float> angles;
  angles.reserve(smooth_pairs_.size());
  for (const Pair& pair : smooth_pairs_)
    angles.push_back(static_cast<float>(
        to_degrees(std::acos(std::clamp(normal(pair.left).dot(normal(pair.right)), -1., 1.)))));
  return static_cast<double>(quantile(angles, quantile_of_facets));
}

double SurfaceMeasures::longest_side() const {
  double longest = 0;
  each_side_inside(surface_, [&](Index a, Index b) {
    longest = std::max(longest, (surface_.points[a] - surface_.points[b]).head<2>().norm());
  });
  return surface_.rho > 0 ? longest / surface_.rho : 0;
}

}  // namespace relievo
