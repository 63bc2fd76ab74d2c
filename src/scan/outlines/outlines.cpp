#include "scan/outlines/outlines.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <functional>

#include "core/disjoint_sets.h"
#include "geometry/plane.h"
#include "relievo/core/parallel.h"
#include "scan/jumps.h"
#include "scan/linear_field.h"
#include "scan/scan_limits.h"

namespace relievo {
namespace {

// The unit of lengths is rho, the sampling distance. The unit of areas is rho^2.
constexpr double least_piece = 20, hole_area = 4;
// Jumps get a wider window than silhouettes, because the nodes of jumps scatter more. These nodes show the
// end of the surface in front, with an error of one rho or more.
constexpr double point_spacing = .75, fair_window = 3, jump_window = 6;
constexpr double shortest_jump = 6, least_occlusion = 3, least_exact_jump = .5;
constexpr double lean_radius = 2.5, farthest_edge = 2;
// The least weight of a node. Nodes whose positions the normals do not determine have this weight.
constexpr double uncertain = .03;
// If the estimated error of a node's position has this size, in rho, the node has half of the full weight.
constexpr double trusted_error = .25;
// The least length of (n_x, n_y) at which normals determine where the surface ends.
constexpr double least_lean = .75;

double area_of(const Surface& surface, const Triangle& t) {
  const auto at = [&](int i) -> Vec2 { return surface.points[t[i]].head<2>(); };
  return cross(at(1) - at(0), at(2) - at(0)) / 2;
}

// Connected components of triangles that are all inside or all outside.
class TriangleComponents {
 public:
  explicit TriangleComponents(const Surface& surface)
      : sets_(surface.triangulation.triangles.size()),
        area_(surface.triangulation.triangles.size(), 0),
        is_open_(area_.size(), 0) {
    const auto& inside = surface.boundary.is_inside;
    for (Index t = 0; t < area_.size(); ++t)
      for (const Index other : surface.triangulation.neighbours[t])
        if (other != no_index && inside[t] == inside[other]) sets_.join(t, other);
    for (Index t = 0; t < area_.size(); ++t) {
      area_[sets_.find(t)] += area_of(surface, surface.triangulation.triangles[t]);
      for (const Index other : surface.triangulation.neighbours[t])
        if (other == no_index) is_open_[sets_.find(t)] = 1;
    }
  }

  double area(Index t) { return area_[sets_.find(t)]; }
  bool is_first(Index t) { return sets_.find(t) == t; }  // true for exactly one triangle of each component
  bool touches_hull(Index t) { return is_open_[sets_.find(t)]; }

 private:
  DisjointSets sets_;
  std::vector<double> area_;
  std::vector<std::uint8_t> is_open_;
};

// Estimates where the surface ends beyond a point, from the normals near the point.
class EdgeFinder {
 public:
  EdgeFinder(const Surface& surface, const PlanePoints& plane)
      : surface_(surface), plane_(plane.places), tree_(plane.tree) {}

  // Returns the position where the normals around a point, extrapolated linearly, become perpendicular to the
  // direction of view. Returns the position of the point, with little weight, if there is no such position
  // within `farthest`.
  CurveNode at(Index i, double farthest) const {
    const CurveNode unknown{plane_[i], uncertain};
    std::vector<KdTree<Vec2>::Match> matches;
    tree_.within(plane_[i], lean_radius * surface_.rho, matches);
    LinearField<2> lean(plane_[i], lean_radius * surface_.rho);
    for (const auto& [j, distance_sq] : matches)
      if (!is_occlusion(surface_, i, j)) lean.add(plane_[j], surface_.normals[j].head<2>().cast<double>());
    const auto fit = lean.fitted();
    if (!fit.is_sloped || fit.value.norm() < least_lean) return unknown;
    const Vec2 outwards = fit.value.normalized();
    const double growth = outwards.dot(fit.gradient.transpose() * outwards);
    if (!(growth > 0)) return unknown;
    const double distance = (1 - fit.value.norm()) / growth;
    if (!(std::abs(distance) <= farthest)) return unknown;
    // If a surface turns away slowly, noise of its normals changes the estimated position much, so this
    // position gets less weight.
    const double error = 2 * fit.misfit / std::sqrt(fit.count) / growth,
                 ratio = error / (trusted_error * surface_.rho);
    const double trust = 1 / (1 + ratio * ratio);
    return {plane_[i] + trust * std::max(0.0, distance) * outwards, std::max(uncertain, trust)};
  }

  const std::vector<Vec2>& plane() const { return plane_; }

 private:
  const Surface& surface_;
  const std::vector<Vec2>& plane_;
  const KdTree<Vec2>& tree_;
};

// Returns the exact outline near `places`. If there are no exact outlines, returns a fair curve through the nodes
// guess(i).
template <typename Guess>
OutlineCurve curve_near(const std::vector<Vec2>& places, const Guess& guess, const OutlineCurve& kind,
                        const ExactOutlines& exact, double rho) {
  OutlineCurve outline = kind;
  if (!exact.empty()) {
    outline.curve = exact.curve(places, kind.is_closed, kind.is_jump, guess);
    return outline;
  }
  std::vector<CurveNode> nodes(places.size());
  parallel_for(
      nodes.size(), [&](std::size_t i) { nodes[i] = guess(i); }, 64);
  const FairCurveOptions silhouette{point_spacing * rho, fair_window * rho};
  outline.curve = fair_curve(nodes, kind.is_closed, kind.is_jump ? jump_curve_options(rho) : silhouette);
  return outline;
}

// The sides of triangles. Side 3 t + i belongs to triangle t and is opposite to the triangle's corner i.
struct Sides {
  const Surface& surface;

  Index from(Index side) const { return surface.triangulation.triangles[side / 3][(side % 3 + 1) % 3]; }
  Index to(Index side) const { return surface.triangulation.triangles[side / 3][(side % 3 + 2) % 3]; }

  // Returns the number that the same edge has as a side of the neighbouring triangle; no_index on the hull.
  Index twin(Index side) const {
    const Index other = surface.triangulation.neighbours[side / 3][side % 3];
    if (other == no_index) return no_index;
    const Triangle& around = surface.triangulation.neighbours[other];
    const auto i = static_cast<Index>(std::ranges::find(around, side / 3) - around.begin());
    return 3 * other + i;
  }

  bool is_boundary(Index side) const {
    const Index other = surface.triangulation.neighbours[side / 3][side % 3];
    return surface.boundary.is_inside[side / 3] && (other == no_index || !surface.boundary.is_inside[other]);
  }

  // `side` is on the boundary of a component of inside triangles. Returns the side that follows it on this
  // boundary.
  Index next_boundary(Index side) const {
    Index turn = side / 3 * 3 + (side % 3 + 1) % 3;
    while (!is_boundary(turn)) {
      turn = twin(turn);
      turn = turn / 3 * 3 + (turn % 3 + 1) % 3;
    }
    return turn;
  }
};

void add_silhouettes(const Surface& surface, const EdgeFinder& finder, const ExactOutlines& exact,
                     std::vector<OutlineCurve>& outlines) {
  const Sides sides{surface};
  const auto count = static_cast<Index>(3 * surface.triangulation.triangles.size());
  std::vector<std::uint8_t> is_done(count, 0);
  for (Index first = 0; first < count; ++first) {
    if (is_done[first] || !sides.is_boundary(first)) continue;
    std::vector<Index> chain;
    for (Index side = first; !is_done[side]; side = sides.next_boundary(side)) {
      is_done[side] = 1;
      chain.push_back(sides.from(side));
    }
    const auto guess = [&](std::size_t i) { return finder.at(chain[i], farthest_edge * surface.rho); };
    std::vector<Vec2> places;
    for (const Index i : chain) places.push_back(finder.plane()[i]);
    OutlineCurve outline = curve_near(places, guess, {{}, true, false}, exact, surface.rho);
    if (!outline.curve.points.empty()) outlines.push_back(std::move(outline));
  }
}

// The jumps as lines that cross sides of triangles. Each crossed side is linked to the next one along the line. The
// surface in front is on the left of the line.
class JumpLines {
 public:
  JumpLines(const Surface& surface, const ExactOutlines& exact)
      : surface_(surface), exact_(exact), sides_{surface} {
    const auto triangles = static_cast<Index>(surface.triangulation.triangles.size());
    next_.assign(3 * std::size_t{triangles}, no_index);
    previous_ = next_;
    for (Index t = 0; t < triangles; ++t)
      if (surface.boundary.is_inside[t]) cross_triangle(t);
  }

  void add_outlines(const EdgeFinder& finder, std::vector<OutlineCurve>& outlines) {
    std::vector<std::uint8_t> is_done(next_.size(), 0);
    const auto follow = [&](Index first, bool is_closed) {
      std::vector<Index> chain;
      std::vector<Vec2> places;
      for (Index side = first; side != no_index && !is_done[side]; side = next_[side]) {
        is_done[side] = 1;
        chain.push_back(side);
        places.push_back((finder.plane()[sides_.from(side)] + finder.plane()[sides_.to(side)]) / 2);
      }
      const auto guess = [&](std::size_t i) { return node_at(chain[i], finder); };
      OutlineCurve outline = curve_near(places, guess, {{}, is_closed, true}, exact_, surface_.rho);
      if (static_cast<double>(outline.curve.points.size()) * point_spacing >= shortest_jump)
        outlines.push_back(std::move(outline));
    };
    for (Index side = 0; side < next_.size(); ++side)
      if (next_[side] != no_index && previous_[side] == no_index) follow(side, false);
    for (Index side = 0; side < next_.size(); ++side)
      if (next_[side] != no_index && !is_done[side]) follow(side, true);
  }

 private:
  // Returns the number of an edge, which is the same for both of its sides.
  Index edge(Index side) const {
    const Index other = sides_.twin(side);
    return other == no_index ? side : std::min(side, other);
  }

  void link(Index from, Index to) {
    from = edge(from), to = edge(to);
    if (next_[from] != no_index || previous_[to] != no_index) return;
    next_[from] = to;
    previous_[to] = from;
  }

  double depth(Index point) const { return surface_.points[point].z(); }

  // Exact outlines also show jumps that is_occlusion() does not find, such as the edge of a fold, where the
  // normals explain the difference in depth.
  bool is_across(Index a, Index b) const {
    const Vec3 &p = surface_.points[a], &q = surface_.points[b];
    if (is_occlusion(surface_, a, b)) return true;
    return !exact_.empty() && std::abs(p.z() - q.z()) > least_exact_jump * surface_.rho &&
           exact_.is_across_jump(p.head<2>(), q.head<2>());
  }

  // Links the two crossed sides of a triangle. Their common corner lies in front of both other corners or
  // behind both.
  void cross_triangle(Index t) {
    const Triangle& corners = surface_.triangulation.triangles[t];
    std::array<bool, 3> jumps;
    for (Index i = 0; i < 3; ++i) jumps[i] = is_across(corners[(i + 1) % 3], corners[(i + 2) % 3]);
    const int count = jumps[0] + jumps[1] + jumps[2];
    if (count < 2) return;
    Index alone = 0;  // the corner whose two sides are crossed
    for (Index i = 0; i < 3; ++i)
      if (count == 3 ? depth(corners[i]) > depth(corners[alone]) : !jumps[i]) alone = i;
    const Index after = (alone + 1) % 3, before = (alone + 2) % 3;
    const double z = depth(corners[alone]), u = depth(corners[after]), v = depth(corners[before]);
    // `leaving` is the side from `alone` to `after`, `arriving` the side from `before` to `alone`.
    const Index leaving = 3 * t + before, arriving = 3 * t + after;
    if (z > u && z > v) link(leaving, arriving);
    if (z < u && z < v) link(arriving, leaving);
  }

  CurveNode node_at(Index side, const EdgeFinder& finder) const {
    Index front = sides_.from(side), back = sides_.to(side);
    if (depth(front) < depth(back)) std::swap(front, back);
    const Vec2 &p = finder.plane()[front], &q = finder.plane()[back];
    const CurveNode node = finder.at(front, (q - p).norm() + .3 * surface_.rho);
    const bool is_towards = (node.place - p).dot(q - p) >= 0;
    if (node.weight > uncertain && is_towards) return node;
    return {(p + q) / 2, uncertain};
  }

  const Surface& surface_;
  const ExactOutlines& exact_;
  Sides sides_;
  std::vector<Index> next_, previous_;  // per edge: the next and previous edge of its line; no_index for none
};

}  // namespace

FairCurveOptions jump_curve_options(double rho, bool is_crease) {
  return {(is_crease ? crease_spacing : point_spacing) * rho, jump_window * rho, fair_window * rho};
}

bool is_occlusion(const Surface& surface, Index a, Index b) {
  const Vec3 step = surface.points[b] - surface.points[a];
  const Vec3 sum = (surface.normals[a] + surface.normals[b]).cast<double>();
  const double rise = std::abs(sum.head<2>().dot(step.head<2>())) / std::max(sum.z(), .2);
  return std::abs(step.z()) > 2 * rise + least_occlusion * surface.rho;
}

bool drop_crumbs(Surface& surface) {
  TriangleComponents components(surface);
  const double unit = surface.rho * surface.rho;
  std::vector<double> areas;
  double all = 0;
  auto& inside = surface.boundary.is_inside;
  for (Index t = 0; t < inside.size(); ++t) {
    if (!inside[t]) continue;
    if (components.is_first(t)) areas.push_back(components.area(t));
    all += area_of(surface, surface.triangulation.triangles[t]);
  }
  const double least =
      std::max(least_piece * unit, surface.view.has_crumbs ? 0 : ScanLimits::crumb_share * all);
  std::ranges::sort(areas, std::greater<>());
  double crumb = areas.empty() ? 0 : std::min(least, .5 * areas.front());
  const auto most = static_cast<std::size_t>(surface.view.most_pieces);
  if (most > 0 && most < areas.size()) crumb = std::max(crumb, areas[most - 1]);
  for (Index t = 0; t < inside.size(); ++t)
    surface.crumbs += inside[t] && components.is_first(t) && components.area(t) < crumb;
  bool is_any = false;
  for (Index t = 0; t < inside.size(); ++t) {
    if (inside[t])
      inside[t] = components.area(t) >= crumb;
    else
      inside[t] = !components.touches_hull(t) && components.area(t) < hole_area * unit;
    is_any |= inside[t] != 0;
  }
  return is_any;
}

std::vector<OutlineCurve> find_outlines(const Surface& surface, const PlanePoints& plane,
                                        const ExactOutlines& exact) {
  const EdgeFinder finder(surface, plane);
  std::vector<OutlineCurve> outlines;
  add_silhouettes(surface, finder, exact, outlines);
  JumpLines(surface, exact).add_outlines(finder, outlines);
  return outlines;
}

std::vector<Segment> segments_of(const std::vector<OutlineCurve>& outlines) {
  std::vector<Segment> segments;
  for (Index c = 0; c < outlines.size(); ++c) {
    const std::vector<Vec2>& points = outlines[c].curve.points;
    const std::size_t n = points.size(), edges = outlines[c].is_closed ? n : n - 1;
    for (std::size_t k = 0; k < edges; ++k) segments.push_back({points[k], points[(k + 1) % n], c});
  }
  return segments;
}

}  // namespace relievo
