#include "plate/front/silhouette.h"

#include <algorithm>

#include "core/disjoint_sets.h"
#include "core/lists.h"
#include "geometry/edges.h"
#include "geometry/plane.h"
#include "geometry/weld.h"
#include "relievo/core/parallel.h"

namespace relievo {
namespace {

// Parts of less than this share of the relief's area are artefacts of the scan.
constexpr double smallest_piece = 1e-3;

// Returns, per point, whether it is pinched: whether the boundary passes it more than once.
std::vector<std::uint8_t> pinched_points(std::span<const Triangle> triangles, std::size_t points) {
  std::vector<std::uint8_t> leaving(points, 0);
  for (const auto& [a, b] : boundary_edges(triangles))
    if (leaving[a] < 2) ++leaving[a];
  for (std::uint8_t& n : leaving) n = n > 1;
  return leaving;
}

// A triangle around a pinched point, which the boundary passes more than once. Sorting groups the triangles by point.
struct Spoke {
  Index point, triangle;
  auto operator<=>(const Spoke&) const = default;
};

bool share_an_edge(const Triangle& s, const Triangle& t) {
  return std::ranges::count_if(s, [&](Index i) { return std::ranges::find(t, i) != t.end(); }) >= 2;
}

// Marks the triangles around one point that do not belong to its largest fan of edge-connected triangles.
void mark_smaller_fans(std::span<const Spoke> around, std::span<const Triangle> triangles,
                       std::vector<std::uint8_t>& is_marked) {
  DisjointSets fans(around.size());
  for (Index i = 0; i < around.size(); ++i)
    for (Index j = 0; j < i; ++j)
      if (share_an_edge(triangles[around[i].triangle], triangles[around[j].triangle])) fans.join(i, j);
  Index largest = 0;
  for (Index i = 1; i < around.size(); ++i)
    if (fans.size_of(i) > fans.size_of(largest)) largest = i;
  for (Index i = 0; i < around.size(); ++i)
    if (fans.find(i) != fans.find(largest)) is_marked[around[i].triangle] = 1;
}

// Removes triangles until the boundary passes every point at most once. Removing a fan may pinch other
// points, so the removal is repeated. The loop ends because each round removes triangles.
void cut_pinches(std::vector<Triangle>& triangles, std::size_t points) {
  while (true) {
    const std::vector<std::uint8_t> is_pinched = pinched_points(triangles, points);
    std::vector<Spoke> spokes;
    for (Index t = 0; t < triangles.size(); ++t)
      for (const Index i : triangles[t])
        if (is_pinched[i]) spokes.push_back({i, t});
    if (spokes.empty()) return;
    std::ranges::sort(spokes);
    std::vector<std::uint8_t> is_marked(triangles.size(), 0);
    for (std::size_t begin = 0, end = 0; begin < spokes.size(); begin = end) {
      while (end < spokes.size() && spokes[end].point == spokes[begin].point) ++end;
      mark_smaller_fans(std::span(spokes).subspan(begin, end - begin), triangles, is_marked);
    }
    keep_where(triangles, [&](std::size_t t) { return !is_marked[t]; });
  }
}

double area_of(const HeightFieldMesh& front, const Triangle& t) {
  const Vec3 u = front.points[t[1]] - front.points[t[0]], v = front.points[t[2]] - front.points[t[0]];
  return cross(u.head<2>(), v.head<2>()) / 2;
}

// Removes the connected parts whose area is less than smallest_piece of the whole area.
void drop_small_pieces(const HeightFieldMesh& front, std::vector<Triangle>& triangles) {
  DisjointSets pieces(front.points.size());
  for (const auto& [a, b, c] : triangles) pieces.join(a, b), pieces.join(b, c);
  std::vector<double> area(front.points.size(), 0);
  double whole = 0;
  for (const Triangle& t : triangles) {
    const double part = area_of(front, t);
    area[pieces.find(t[0])] += part;
    whole += part;
  }
  std::erase_if(triangles,
                [&](const Triangle& t) { return area[pieces.find(t[0])] < smallest_piece * whole; });
}

// Returns the front with only these triangles and their points.
HeightFieldMesh with_used_points(const HeightFieldMesh& front, std::vector<Triangle> triangles) {
  HeightFieldMesh alone{front.points, std::move(triangles), {}, front.ground_mm, front.colours};
  drop_unused(alone);
  return alone;
}

// Says whether a point of a front belongs to the ground, to the relief or to the boundary between them.
enum class Kind : std::uint8_t { ground, relief, boundary };

std::vector<Kind> kinds_of(const HeightFieldMesh& front, std::span<const BoundaryEdge> boundary) {
  std::vector<Kind> kinds(front.points.size(), Kind::ground);
  for (const Triangle& t : relief_triangles(front))
    for (const Index i : t) kinds[i] = Kind::relief;
  for (const auto& [a, b] : boundary) kinds[a] = kinds[b] = Kind::boundary;
  return kinds;
}

// Returns whether `place` is inside the boundary. It is inside if a ray from it crosses the boundary an odd
// number of times.
bool is_within(const HeightFieldMesh& front, std::span<const BoundaryEdge> boundary, const Vec2& place) {
  bool is_inside = false;
  for (const BoundaryEdge& edge : boundary) {
    const Vec3 &a = front.points[edge[0]], &b = front.points[edge[1]];
    if ((a.y() > place.y()) == (b.y() > place.y())) continue;
    const double x = a.x() + (place.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
    is_inside ^= x > place.x();
  }
  return is_inside;
}

}  // namespace

std::vector<BoundaryEdge> boundary_edges(std::span<const Triangle> triangles) {
  std::vector<BoundaryEdge> boundary;
  each_edge(triangles, [&](std::span<const TriangleSide> sides) {
    for (const TriangleSide& side : sides)
      if (std::ranges::count(sides, side.to, &TriangleSide::from) == 0)
        boundary.push_back({side.from, side.to});
  });
  std::ranges::sort(boundary);
  return boundary;
}

std::vector<Triangle> relief_triangles(const HeightFieldMesh& front) {
  std::vector<Triangle> triangles = front.triangles;
  if (!front.is_relief.empty()) keep_where(triangles, [&](std::size_t t) { return front.is_relief[t] != 0; });
  return triangles;
}

std::vector<std::uint8_t> relief_within(const HeightFieldMesh& front, const HeightFieldMesh& simpler,
                                        std::span<const Index> original) {
  const std::vector<BoundaryEdge> boundary = boundary_edges(relief_triangles(front));
  const std::vector<Kind> kinds = kinds_of(front, boundary);
  std::vector<std::uint8_t> is_relief(simpler.triangles.size());
  parallel_for(is_relief.size(), [&](std::size_t t) {
    const Triangle& corners = simpler.triangles[t];
    const auto has = [&](Kind kind) {
      return std::ranges::any_of(
          corners, [&](Index i) { return original[i] != no_index && kinds[original[i]] == kind; });
    };
    // A triangle with points on only one side of the silhouette lies on that side.
    if (has(Kind::ground) != has(Kind::relief)) {
      is_relief[t] = has(Kind::relief);
      return;
    }
    const Vec3 sum = simpler.points[corners[0]] + simpler.points[corners[1]] + simpler.points[corners[2]];
    is_relief[t] = is_within(front, boundary, sum.head<2>() / 3);
  });
  return is_relief;
}

HeightFieldMesh relief_alone(const HeightFieldMesh& front) {
  std::vector<Triangle> triangles = relief_triangles(front);
  cut_pinches(triangles, front.points.size());
  drop_small_pieces(front, triangles);
  return with_used_points(front, std::move(triangles));
}

}  // namespace relievo
