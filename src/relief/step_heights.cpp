#include "relief/step_heights.h"

#include <algorithm>

#include "geometry/edges.h"
#include "relief/edge_weight.h"
#include "relievo/relief/heights.h"
#include "relievo/scan/surface.h"
#include "scan/jumps.h"

namespace relievo {
namespace {

// Slopes explain a part of a depth difference. A slope steeper than this counts as this slope, because near a
// silhouette, steeper normals are too inaccurate to predict depth.
constexpr double steepest_slope = 4;

std::vector<WeightedLink> jump_edges(const Surface& surface) {
  const std::vector<std::uint8_t> jumps = jump_triangles(surface);
  return weighted_links(surface, [&](const TriangleSide& side) {
    return jumps[side.triangle] && is_jump(surface, side.from, side.to);
  });
}

std::vector<WeightedLink> wall_edges(const Surface& surface) {
  const Boundary& boundary = surface.boundary;
  return weighted_links(surface, [&](const TriangleSide& side) {
    return boundary.is_inside[side.triangle] && boundary.is_across_wall(side.from, side.to);
  });
}

// A position on the surface, and the normal at this position.
struct Place {
  Vec3 point;
  Vec3f normal;
};

// Returns the part of the difference in z from a to b that the slopes at a and b do not explain.
double step_between(const Place& a, const Place& b) {
  const Vec3 step = b.point - a.point;
  const auto rise = [&](const Vec3f& n) {
    const double slope = -static_cast<double>(n.head<2>().dot(step.head<2>().cast<float>())) /
                         std::max(static_cast<double>(n.z()), 1e-6);
    const double most = steepest_slope * step.head<2>().norm();
    return std::clamp(slope, -most, most);
  };
  const double jump = step.z() - (rise(a.normal) + rise(b.normal)) / 2;
  return jump * step.z() > 0 ? jump : 0;
}

Place place_of(const Surface& surface, Index i) {
  return {surface.points[i], surface.normals[i]};
}

// Numbers the points that are joined to a wall by at most `steps` edges. Returns the number of each point; no_index for
// all others.
std::vector<Index> numbers_near_walls(const Surface& surface, int steps) {
  std::vector<std::uint8_t> is_near(surface.points.size());
  for (std::size_t i = 0; i < surface.boundary.wall_side.size(); ++i)
    is_near[i] = surface.boundary.wall_side[i] != WallSide::none;
  for (int step = 0; step < steps; ++step) {
    const std::vector<std::uint8_t> before = is_near;
    for (const Triangle& t : surface.triangulation.triangles)
      if (before[t[0]] || before[t[1]] || before[t[2]]) is_near[t[0]] = is_near[t[1]] = is_near[t[2]] = 1;
  }
  std::vector<Index> numbers(is_near.size(), no_index);
  Index next = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (is_near[i]) numbers[i] = next++;
  return numbers;
}

// Computes the mean position and normal on each side of the walls, over about two sampling distances. Single
// points would not do. A chin before a neck, for example, can turn away from the viewer so far that its last
// rows of points are nearly as deep as the neck. The mean positions still differ by the distance in depth
// between chin and neck.
class MeansBesideWalls {
 public:
  explicit MeansBesideWalls(const Surface& surface) : numbers_(numbers_near_walls(surface, rounds)) {
    for (Index i = 0; i < numbers_.size(); ++i)
      if (numbers_[i] != no_index) means_.push_back(place_of(surface, i));
    const auto edges = weighted_links(surface, [&](const TriangleSide& side) {
      return numbers_[side.from] != no_index && numbers_[side.to] != no_index &&
             surface.boundary.is_inside[side.triangle] &&
             !surface.boundary.is_across_wall(side.from, side.to);
    });
    for (int round = 0; round < rounds; ++round) average(edges);
  }

  // Returns the mean at a point on the edge of a wall.
  const Place& at(Index point) const { return means_[numbers_[point]]; }

 private:
  static constexpr int rounds = 4;

  // Replaces each place by the mean of itself and its neighbours.
  void average(std::span<const WeightedLink> edges) {
    std::vector<Place> sums = means_;
    std::vector<float> count(means_.size(), 1);
    const auto add = [&](Index to, Index from) {
      sums[to].point += means_[from].point, sums[to].normal += means_[from].normal, ++count[to];
    };
    for (const auto& [a, b, weight] : edges) {
      add(numbers_[a], numbers_[b]);
      add(numbers_[b], numbers_[a]);
    }
    for (std::size_t i = 0; i < sums.size(); ++i)
      means_[i] = {sums[i].point / static_cast<double>(count[i]), sums[i].normal / count[i]};
  }

  std::vector<Index> numbers_;
  std::vector<Place> means_;
};

// Returns the least-squares solution of equation (9) for given height differences. Across each of the given
// edges, the height of b should exceed that of a by difference(a, b). Across every other edge, the heights of
// the two ends should be equal.
template <typename Difference>
StepHeights solve_steps(const Boundary& boundary, std::span<const WeightedLink> edges,
                        const HeightSystem& system, Difference difference) {
  if (edges.empty()) return {};
  std::vector<double> z(boundary.is_boundary.size(), 0);
  for (const WeightedLink& e : edges) {
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
  const MeansBesideWalls means(surface);
  const auto step = [&](Index a, Index b) {
    return step_between(place_of(surface, a), place_of(surface, b));
  };
  const auto plane = [&](Index a, Index b) {
    // Results of tanh differ in the last bits between standard libraries. Rounding to single
    // precision removes these bits.
    return static_cast<double>(static_cast<float>(std::tanh(step_between(means.at(a), means.at(b)) / scale)));
  };
  StepFields found;
  parallel_both([&] { found.steps = solve_steps(surface.boundary, jump_edges(surface), system, step); },
                [&] { found.planes = solve_steps(surface.boundary, wall_edges(surface), system, plane); });
  return found;
}

}  // namespace relievo
