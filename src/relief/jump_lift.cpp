#include "relief/jump_lift.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/groups.h"
#include "geometry/neighbours.h"
#include "relief/edge_weight.h"
#include "relief/style.h"
#include "relievo/relief/heights.h"
#include "relievo/scan/surface.h"

namespace relievo {
namespace {

// The field falls by the factor e over `fading_distance`, a share of the longer side, and ends after `extent`
// such distances. See docs/decisions/jump-lift.md.
constexpr double fading_distance = .015, extent = 3;
// Inversions below this share of the longer side are too small to be seen.
constexpr double least_inversion = 1e-5;
constexpr int rounds = 3, sweeps_per_round = 20;
constexpr float over_relaxation = 1.75F;
// The height share of the shapes for which the fields are computed.
constexpr double reference_share = .5;

using Field = std::vector<float>;
using Values = Eigen::Array4f;  // one for each knot

// An edge of a triangle, and the half weight that the triangle gives it.
struct HalfEdge {
  Index a, b;
  float weight;
};

// Returns the edges of a triangle with their half weights in (9). With equal weights a field would depend on
// how uneven the triangles are. Triangles of walls are too thin for the weights of (9): their edges across
// the wall get the weight of edges of equilateral triangles, and their other edges get weight 0.
std::array<HalfEdge, 3> half_edges(const Surface& surface, const Triangle& corners) {
  std::array<HalfEdge, 3> edges;
  const auto plane = [&](std::size_t i) { return Vec2(surface.points[corners[i % 3]].head<2>()); };
  double stiffest = 0;
  bool is_wall = false;
  for (std::size_t i = 0; i < 3; ++i) {
    const double half = half_edge_weight(plane(i), plane(i + 1), plane(i + 2));
    edges[i] = {corners[(i + 1) % 3], corners[(i + 2) % 3], static_cast<float>(half)};
    stiffest = std::max(stiffest, half);
    is_wall = is_wall || surface.boundary.is_across_wall(edges[i].a, edges[i].b);
  }
  for (HalfEdge& e : edges)
    if (is_wall)
      e.weight = surface.boundary.is_across_wall(e.a, e.b) ? std::numbers::inv_sqrt3_v<float> / 2 : 0;
    else
      e.weight *= static_cast<float>(needle_share(stiffest));
  return edges;
}

// Returns the edges of triangles inside the relief that have at least one movable end.
std::vector<HalfEdge> movable_edges(const Surface& surface, std::span<const std::uint8_t> is_movable) {
  std::vector<HalfEdge> edges;
  for (std::size_t t = 0; t < surface.triangulation.triangles.size(); ++t) {
    const Triangle& corners = surface.triangulation.triangles[t];
    if (!surface.boundary.is_inside[t] ||
        std::ranges::none_of(corners, [&](Index i) { return is_movable[i]; }))
      continue;
    for (const HalfEdge& edge : half_edges(surface, corners))
      if (is_movable[edge.a] || is_movable[edge.b]) edges.push_back(edge);
  }
  return edges;
}

// Returns 1 if a is in front of b across a jump, -1 if it is behind, and 0 if there is no jump between them.
int side_of_jump(const Boundary& boundary, Index a, Index b) {
  if (!boundary.is_across_wall(a, b)) return 0;
  return boundary.wall_side[a] == WallSide::front ? 1 : -1;
}

// Returns for each of JumpLift::knots the heights that solve equation (9) for the default layered shape, with
// the knot as u and reference_share as the height share.
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

// The movable points around inverted jumps, with their edges.
struct Band {
  struct Edge {
    // The number of the other point in the band. points.size() stands for all points outside the band, which do
    // not move.
    Index to;
    int side;  // see side_of_jump()
    float weight;
  };
  std::vector<Index> points;
  Groups<Edge> edges;
};

// Returns one end of each edge across a jump that is inverted at one of the knots.
std::vector<Vec2> inverted_places(const Surface& surface, std::span<const Field> heights) {
  const auto least = static_cast<float>(least_inversion * surface.longer_side());
  std::vector<Vec2> inverted;
  for (std::size_t t = 0; t < surface.triangulation.triangles.size(); ++t) {
    const Triangle& corners = surface.triangulation.triangles[t];
    for (std::size_t i = 0; i < 3 && surface.boundary.is_inside[t]; ++i) {
      const Index a = corners[(i + 1) % 3], b = corners[(i + 2) % 3];
      const int side = side_of_jump(surface.boundary, a, b);
      const auto sign = static_cast<float>(side);
      if (side != 0 &&
          std::ranges::any_of(heights, [&](const Field& z) { return sign * (z[b] - z[a]) > least; }))
        inverted.push_back(surface.points[a].head<2>());
    }
  }
  return inverted;
}

// Decides whether points are near one of the positions in a tree. Points are asked for in an order in which
// neighbours follow each other, so the distance of one point often decides for the next.
class NearPlaces {
 public:
  NearPlaces(const KdTree<Vec2>& tree, double distance) : tree_(tree), distance_(distance) {}

  bool is_near(const Vec2& p) {
    constexpr double rounding = 1e-9;
    const double step = (p - asked_).norm();
    if (known_ - step > distance_ * (1 + rounding)) return false;
    if (known_ + step < distance_ * (1 - rounding)) return true;
    Index nearest;
    double distance_sq = std::numeric_limits<double>::infinity();
    tree_.nearest(p, 1, &nearest, &distance_sq);
    asked_ = p;
    known_ = std::sqrt(distance_sq);
    return distance_sq < distance_ * distance_;
  }

 private:
  const KdTree<Vec2>& tree_;
  double distance_;
  Vec2 asked_ = Vec2::Zero();
  double known_ = std::numeric_limits<double>::quiet_NaN();  // distance of asked_ to the nearest position
};

// Returns for each point whether it is not on the silhouette and is near a jump that is inverted at one of
// the knots.
std::vector<std::uint8_t> movable_points(const Surface& surface, std::span<const Field> heights,
                                         double distance) {
  const std::vector<Vec2> inverted = inverted_places(surface, heights);
  const KdTree<Vec2> tree(inverted);
  std::vector<std::uint8_t> is_movable(surface.points.size(), 0);
  parallel_ranges(is_movable.size(), default_grain, [&](std::size_t begin, std::size_t end) {
    NearPlaces near(tree, distance);
    for (std::size_t i = begin; i < end; ++i)
      is_movable[i] = !surface.boundary.is_boundary[i] && near.is_near(surface.points[i].head<2>());
  });
  return is_movable;
}

Band band_of(const Surface& surface, std::span<const std::uint8_t> is_movable) {
  Band band;
  std::vector<Index> number(is_movable.size());
  for (Index i = 0; i < is_movable.size(); ++i)
    if (is_movable[i]) number[i] = static_cast<Index>(band.points.size()), band.points.push_back(i);
  const auto outside = static_cast<Index>(band.points.size());
  const std::vector<HalfEdge> edges = movable_edges(surface, is_movable);
  band.edges = grouped<Band::Edge>(band.points.size(), [&](auto&& add) {
    for (const HalfEdge& e : edges) {
      const int side = side_of_jump(surface.boundary, e.a, e.b);
      if (is_movable[e.a]) add(number[e.a], {is_movable[e.b] ? number[e.b] : outside, side, e.weight});
      if (is_movable[e.b]) add(number[e.b], {is_movable[e.a] ? number[e.a] : outside, -side, e.weight});
    }
  });
  return band;
}

// Computes the fields y for all knots at once. They minimise the sum over the band's edges of weight (y_p -
// y_q - aim)^2 plus the sum over the band's points of screen y_p^2.
class BandFields {
 public:
  BandFields(const Band& band, std::span<const Field> heights, float screen)
      : band_(band),
        heights_(band.points.size() + 1, Values::Zero()),
        y_(heights_),
        aims_(band.edges.items.size(), Values::Zero()),
        pulls_(band.points.size()),
        weights_(band.points.size(), screen) {
    for (Index i = 0; i < band.points.size(); ++i) {
      for (std::size_t k = 0; k < heights.size(); ++k)
        heights_[i][static_cast<Eigen::Index>(k)] = heights[k][band.points[i]];
      for (const Band::Edge& edge : band.edges[i]) weights_[i] += edge.weight;
    }
  }

  std::vector<Values> find() {
    for (int round = 0; round < rounds; ++round) {
      raise_aims();
      for (int sweep = 0; sweep < sweeps_per_round; ++sweep) relax();
    }
    y_.pop_back();
    return std::move(y_);
  }

 private:
  // Raises the aim of each edge across a jump by the inversion that is left.
  void raise_aims() {
    for (Index i = 0; i < band_.points.size(); ++i) {
      pulls_[i] = Values::Zero();
      for (Index e = band_.edges.begin[i]; e < band_.edges.begin[i + 1]; ++e) {
        const auto [to, side, weight] = band_.edges.items[e];
        if (side == 0 || to == band_.points.size()) continue;
        const auto sign = static_cast<float>(side);
        const Values inversion = sign * (heights_[to] + y_[to] - heights_[i] - y_[i]);
        aims_[e] = sign * (sign * aims_[e] + inversion).max(0.F);
        pulls_[i] += weight * aims_[e];
      }
    }
  }

  void relax() {
    for (Index i = 0; i < band_.points.size(); ++i) {
      Values sum = pulls_[i];
      for (const auto& [to, side, weight] : band_.edges[i]) sum += weight * y_[to];
      y_[i] += over_relaxation * (sum / weights_[i] - y_[i]);
    }
  }

  const Band& band_;
  std::vector<Values> heights_, y_;  // with one more element for all points outside
  std::vector<Values> aims_;         // per edge
  std::vector<Values> pulls_;        // per point: the sum of weight times aim over its edges
  std::vector<float> weights_;       // per point: the screen plus the sum of its edges' weights
};

}  // namespace

JumpLift JumpLift::find(const JumpLiftInput& input) {
  const Surface& surface = input.surface;
  if (surface.boundary.wall_side.empty()) return {};
  const std::vector<Field> heights = reference_heights(input);
  const double distance = fading_distance * surface.longer_side();
  const Band band = band_of(surface, movable_points(surface, heights, extent * distance));
  const double area = std::numbers::sqrt3 / 2 * surface.rho * surface.rho;  // area per point
  const auto screen = static_cast<float>(area / (distance * distance));
  JumpLift lift;
  lift.fields_ = BandFields(band, heights, screen).find();
  lift.points_ = band.points;
  return lift;
}

namespace {

// Returns the exponent in the weight of the coarse layer, 1 - exp(-exponent).
double coarse_exponent(double u, double gamma) {
  return -std::log1p(-static_cast<double>(LayerWeights::of(u, gamma, 1).coarse));
}

}  // namespace

// Coarse layers cause the inversions of depth jumps, and the weight of these layers depends on u and gamma.
// Both are converted to the u that gives the same weight with the gamma of layered_shape(), for which the
// knots' fields are computed.
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
