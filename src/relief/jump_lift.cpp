#include "relief/jump_lift.h"

#include <algorithm>
#include <cmath>

#include "core/groups.h"
#include "geometry/extent.h"
#include "geometry/neighbours.h"
#include "relief/style.h"
#include "relievo/relief/heights.h"
#include "relievo/scan/surface.h"

namespace relievo {
namespace {

// The distance over which the field falls by e, as a share of the longer side, and how many of these distances it extends.
// docs/decisions/jump-lift.md has the reasons of all constants.
constexpr double fading_distance = .015, extent = 3;
// Near a high jump an edge that is steeper than this, by more than rho, is part of its wall.
constexpr double steepest_slope = 3;
// Of the longer side: smaller inversions are not seen.
constexpr double least_inversion = 1e-5;
constexpr int rounds = 3, sweeps_per_round = 20;
constexpr float over_relaxation = 1.5F;
// The height share of the shapes that the fields are found for.
constexpr double reference_share = .5;

using Field = std::vector<float>;
using Values = Eigen::Array4f;  // one for each knot

template <typename F>
void for_each_edge_inside(const Surface& surface, F&& f) {
  for (std::size_t t = 0; t < surface.triangulation.triangles.size(); ++t) {
    if (!surface.boundary.is_inside[t]) continue;
    const Triangle& corners = surface.triangulation.triangles[t];
    for (std::size_t i = 0; i < 3; ++i)
      if (const Index a = corners[i], b = corners[(i + 1) % 3]; a < b) f(a, b);
  }
}

// Returns 1 if a is in front of b across a jump, -1 if it is behind, and 0 if there is no jump between them.
int side_of_jump(const Surface& surface, std::span<const float> weights, Index a, Index b) {
  if (surface.boundary.is_across_wall(a, b)) return surface.boundary.wall_side[a] == WallSide::front ? 1 : -1;
  const Vec3 step = surface.points[a] - surface.points[b];
  const bool is_near_high_jump = weights[a] + weights[b] < 1;
  if (!is_near_high_jump || std::abs(step.z()) <= steepest_slope * step.head<2>().norm() + surface.rho)
    return 0;
  return step.z() > 0 ? 1 : -1;
}

// Returns the heights that (9) gives the default layered shape at each knot.
std::vector<Field> reference_heights(const JumpLiftInput& input) {
  const Surface& surface = input.surface;
  Shape shape = layered_shape();
  shape.membrane = MembraneParams{reference_share};
  const std::vector<float> boundary_weight =
      boundary_weights(surface.boundary.distance, boundary_rho(surface, shape.boundary_width));
  const SlopeInput slope = slope_input(surface, input.layers, boundary_weight);
  HeightSystem::Workspace workspace = input.system.make_workspace();
  std::vector<Vec2> slopes(surface.points.size());
  std::vector<Vec2f> single(slopes.size());
  std::vector<Field> heights;
  for (const double u : JumpLift::knots) {
    shape.compression.u = u;
    find_slopes(slope, shape, slopes);
    parallel_for(slopes.size(), [&](std::size_t i) { single[i] = slopes[i].cast<float>(); });
    heights.emplace_back(slopes.size());
    input.system.solve(single, heights.back(), workspace);
  }
  return heights;
}

// The points around inverted jumps, which may move, with their edges.
struct Band {
  struct Edge {
    Index to;  // number in the band; points.size() stands for all points outside, which do not move
    int side;  // see side_of_jump()
  };
  std::vector<Index> points;
  Groups<Edge> edges;
};

// Returns whether each point is near a jump that is inverted at one of the knots, and not on the silhouette.
std::vector<std::uint8_t> movable_points(const JumpLiftInput& input, std::span<const Field> heights,
                                         double distance) {
  const Surface& surface = input.surface;
  const auto least = static_cast<float>(least_inversion * longer_side_of(surface.points));
  std::vector<Vec2> inverted;
  for_each_edge_inside(surface, [&](Index a, Index b) {
    const auto side = static_cast<float>(side_of_jump(surface, input.weights, a, b));
    if (std::ranges::any_of(heights, [&](const Field& z) { return side * (z[b] - z[a]) > least; }))
      inverted.push_back(surface.points[a].head<2>());
  });
  const KdTree<Vec2> tree(inverted);
  std::vector<std::uint8_t> is_movable(surface.points.size(), 0);
  parallel_for(is_movable.size(), [&](std::size_t i) {
    Index nearest;
    double distance_sq;
    is_movable[i] = !surface.boundary.is_boundary[i] &&
                    tree.nearest(surface.points[i].head<2>(), 1, &nearest, &distance_sq) &&
                    distance_sq < distance * distance;
  });
  return is_movable;
}

Band band_of(const JumpLiftInput& input, std::span<const std::uint8_t> is_movable) {
  Band band;
  std::vector<Index> number(is_movable.size());
  for (Index i = 0; i < is_movable.size(); ++i)
    if (is_movable[i]) number[i] = static_cast<Index>(band.points.size()), band.points.push_back(i);
  const auto outside = static_cast<Index>(band.points.size());
  band.edges = grouped<Band::Edge>(band.points.size(), [&](auto&& add) {
    for_each_edge_inside(input.surface, [&](Index a, Index b) {
      if (!is_movable[a] && !is_movable[b]) return;
      const int side = side_of_jump(input.surface, input.weights, a, b);
      if (is_movable[a]) add(number[a], {is_movable[b] ? number[b] : outside, side});
      if (is_movable[b]) add(number[b], {is_movable[a] ? number[a] : outside, -side});
    });
  });
  return band;
}

// Minimises the sum over the band's edges of (y_p - y_q - aim)^2, and of screen y_p^2 over its points, for all knots at
// once.
class BandFields {
 public:
  BandFields(const Band& band, std::span<const Field> heights, float screen)
      : band_(band),
        screen_(screen),
        heights_(band.points.size() + 1, Values::Zero()),
        y_(heights_),
        aims_(band.edges.items.size(), Values::Zero()) {
    for (std::size_t i = 0; i < band.points.size(); ++i)
      for (std::size_t k = 0; k < heights.size(); ++k)
        heights_[i][static_cast<Eigen::Index>(k)] = heights[k][band.points[i]];
  }

  std::vector<Values> find() {
    for (int round = 0; round < rounds; ++round) {
      raise_aims();
      for (int sweep = 0; sweep < sweeps_per_round; ++sweep) relax(sweep % 2 != 0);
    }
    y_.pop_back();
    return std::move(y_);
  }

 private:
  // Raises the aim of each edge across a jump by what is left of its inversion.
  void raise_aims() {
    for (Index i = 0; i < band_.points.size(); ++i)
      for (Index e = band_.edges.begin[i]; e < band_.edges.begin[i + 1]; ++e) {
        const auto [to, side] = band_.edges.items[e];
        if (side == 0 || to == band_.points.size()) continue;
        const auto sign = static_cast<float>(side);
        const Values inversion = sign * (heights_[to] + y_[to] - heights_[i] - y_[i]);
        aims_[e] = sign * (sign * aims_[e] + inversion).max(0.F);
      }
  }

  void relax(bool is_backwards) {
    const auto n = static_cast<Index>(band_.points.size());
    for (Index k = 0; k < n; ++k) {
      const Index i = is_backwards ? n - 1 - k : k;
      Values sum = Values::Zero();
      for (Index e = band_.edges.begin[i]; e < band_.edges.begin[i + 1]; ++e)
        sum += y_[band_.edges.items[e].to] + aims_[e];
      const float scale = 1 / (static_cast<float>(band_.edges[i].size()) + screen_);
      y_[i] += over_relaxation * (scale * sum - y_[i]);
    }
  }

  const Band& band_;
  float screen_;
  std::vector<Values> heights_, y_, aims_;  // heights_ and y_ have one element more, for all points outside
};

}  // namespace

JumpLift JumpLift::find(const JumpLiftInput& input) {
  const std::vector<Field> heights = reference_heights(input);
  const Surface& surface = input.surface;
  const double distance = fading_distance * longer_side_of(surface.points);
  const Band band = band_of(input, movable_points(input, heights, extent * distance));
  // The sum over six edges of length rho is 1.5 rho^2 times the Laplacian.
  const auto screen = static_cast<float>(1.5 * surface.rho * surface.rho / (distance * distance));
  JumpLift lift;
  lift.fields_ = BandFields(band, heights, screen).find();
  lift.points_ = band.points;
  return lift;
}

namespace {

// Returns the exponent of the weight of coarse layers.
double coarse_exponent(double u, double gamma) {
  return -std::log1p(-static_cast<double>(LayerWeights::of(u, gamma, 1).coarse));
}

}  // namespace

// Inversions come from coarse layers, and another gamma changes their weight as another u does.
Eigen::Array4f JumpLift::shares_at(const Shape& shape) const {
  Eigen::Array4f shares = Eigen::Array4f::Zero();
  if (shape.style != Style::layered || std::isinf(shape.membrane->pull_length)) return shares;
  const double u =
      std::min(coarse_exponent(shape.compression.u, shape.gamma) / coarse_exponent(1, layered_shape().gamma),
               knots.back());
  const double scale = (2 - shape.membrane->height_share) / (2 - reference_share);
  if (u <= knots.front()) {
    shares[0] = static_cast<float>(scale * u / knots.front());
    return shares;
  }
  const double at = std::log(u / knots[0]) / std::log(knots[1] / knots[0]);
  const auto before = std::min(static_cast<Eigen::Index>(at), shares.size() - 2);
  const double part = at - static_cast<double>(before);
  shares[before] = static_cast<float>(scale * (1 - part));
  shares[before + 1] = static_cast<float>(scale * part);
  return shares;
}

std::size_t JumpLift::memory() const {
  return points_.size() * (sizeof(Index) + sizeof(Eigen::Array4f));
}

}  // namespace relievo
