#include "relief/step_heights.h"

#include <algorithm>
#include <cmath>

#include "geometry/edges.h"
#include "relief/edge_weight.h"
#include "relievo/relief/heights.h"
#include "relievo/scan/surface.h"
#include "scan/jumps.h"

namespace relievo {
namespace {

// The limit of the slopes that explain a part of a depth difference. Near a silhouette, steeper normals are
// too inaccurate to predict depth.
constexpr double steepest_slope = 4;

struct JumpEdge {
  Index a, b;
  float weight;
};

// Returns the edges of triangles inside the relief across which the depth jumps, with their weights in (9).
std::vector<JumpEdge> jump_edges(const Surface& surface) {
  const std::vector<std::uint8_t> jumps = jump_triangles(surface);
  const auto is_wanted = [&](const TriangleSide& side) {
    return jumps[side.triangle] && is_jump(surface, side.from, side.to);
  };
  std::vector<JumpEdge> edges;
  each_edge(surface.triangulation.triangles, is_wanted, [&](std::span<const TriangleSide> sides) {
    edges.push_back({sides[0].low(), sides[0].high(), edge_weight(surface.points, sides)});
  });
  return edges;
}

// Returns the depth of b minus the depth of a, minus the difference that the slopes at both points explain.
double step_between(const Surface& surface, Index a, Index b) {
  const Vec3 step = surface.points[b] - surface.points[a];
  const auto rise = [&](Index i) {
    const Vec3f& n = surface.normals[i];
    const double slope = -static_cast<double>(n.head<2>().dot(step.head<2>().cast<float>())) /
                         std::max(static_cast<double>(n.z()), 1e-6);
    const double most = steepest_slope * step.head<2>().norm();
    return std::clamp(slope, -most, most);
  };
  const double jump = step.z() - (rise(a) + rise(b)) / 2;
  return jump * step.z() > 0 ? jump : 0;
}

// Returns the least-squares solution of (9) for given height differences across the jump edges. difference(a,
// b) is the wanted height of b minus that of a.
template <typename Difference>
StepHeights solve_steps(const Boundary& boundary, std::span<const JumpEdge> edges, const HeightSystem& system,
                        Difference difference) {
  if (edges.empty()) return {};
  std::vector<double> z(boundary.is_boundary.size(), 0);
  for (const JumpEdge& e : edges) {
    const double pull = static_cast<double>(e.weight) * difference(e.a, e.b);
    z[e.a] -= pull;
    z[e.b] += pull;
  }
  for (std::size_t i = 0; i < z.size(); ++i)
    if (boundary.is_boundary[i]) z[i] = 0;
  system.solve_in_place(z);
  return {{z.begin(), z.end()}, height_span(z)};
}

}  // namespace

StepFields StepFields::find(const Surface& surface, const HeightSystem& system) {
  constexpr double deep = .05;  // depth of a deep jump, as a share of the longer side
  const double scale = deep * surface.longer_side();
  const Boundary& boundary = surface.boundary;
  const std::vector<JumpEdge> edges = jump_edges(surface);
  const auto step = [&](Index a, Index b) { return step_between(surface, a, b); };
  const auto plane = [&](Index a, Index b) {
    // Standard libraries differ in the last bits of tanh. Rounding to single precision hides that.
    const auto saturated = [&] {
      return static_cast<double>(static_cast<float>(std::tanh(step(a, b) / scale)));
    };
    return boundary.is_across_wall(a, b) ? saturated() : 0;
  };
  StepFields found;
  parallel_both([&] { found.steps = solve_steps(boundary, edges, system, step); },
                [&] { found.planes = solve_steps(boundary, edges, system, plane); });
  return found;
}

}  // namespace relievo
