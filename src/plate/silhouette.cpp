#include "silhouette.h"

#include <algorithm>

#include "core/disjoint_sets.h"
#include "relievo/core/parallel.h"

namespace relievo {
namespace {

constexpr double smallest_piece = 1e-3;  // of the whole relief's area

std::vector<std::uint8_t> pinched_points(std::span<const Triangle> triangles, std::size_t points) {
  std::vector<std::uint8_t> leaving(points, 0);
  for (const auto& [a, b] : rim_of(triangles))
    if (leaving[a] < 2) ++leaving[a];
  for (std::uint8_t& n : leaving) n = n > 1;
  return leaving;
}

// A triangle around a point.
struct Spoke {
  Index point, triangle;
  auto operator<=>(const Spoke&) const = default;
};

bool share_an_edge(const Triangle& s, const Triangle& t) {
  return std::ranges::count_if(s, [&](Index i) { return std::ranges::find(t, i) != t.end(); }) >= 2;
}

// Marks the triangles around one point that do not belong to the largest fan of neighbours.
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

void remove(std::vector<Triangle>& triangles, const std::vector<std::uint8_t>& is_marked) {
  std::size_t kept = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    if (!is_marked[t]) triangles[kept++] = triangles[t];
  triangles.resize(kept);
}

// Leaves out triangles until every point of the rim has one edge of it coming and one going.
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
    remove(triangles, is_marked);
  }
}

double area_of(const Front& front, const Triangle& t) {
  const Vec3 u = front.points[t[1]] - front.points[t[0]], v = front.points[t[2]] - front.points[t[0]];
  return (u.x() * v.y() - u.y() * v.x()) / 2;
}

void drop_specks(const Front& front, std::vector<Triangle>& triangles) {
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

// The front of these triangles, with the points they use.
Front front_of(const Front& front, std::vector<Triangle> triangles) {
  std::vector<Index> place(front.points.size(), no_index);
  for (const Triangle& t : triangles)
    for (const Index i : t) place[i] = 0;
  Front alone{{}, std::move(triangles), {}, front.ground_mm};
  for (std::size_t i = 0; i < place.size(); ++i) {
    if (place[i] == no_index) continue;
    place[i] = static_cast<Index>(alone.points.size());
    alone.points.push_back(front.points[i]);
    if (!front.colours.empty()) alone.colours.push_back(front.colours[i]);
  }
  for (Triangle& t : alone.triangles)
    for (Index& i : t) i = place[i];
  return alone;
}

enum class Kind : std::uint8_t { ground, relief, rim, unknown };

std::vector<Kind> kinds_of(const Front& front, std::span<const RimEdge> rim) {
  std::vector<Kind> kinds(front.points.size(), Kind::ground);
  for (const Triangle& t : relief_triangles(front))
    for (const Index i : t) kinds[i] = Kind::relief;
  for (const auto& [a, b] : rim) kinds[a] = kinds[b] = Kind::rim;
  return kinds;
}

// Does a ray from the place cross the rim an odd number of times?
bool is_within(const Front& front, std::span<const RimEdge> rim, const Vec2& place) {
  bool is_inside = false;
  for (const RimEdge& edge : rim) {
    const Vec3 &a = front.points[edge[0]], &b = front.points[edge[1]];
    if ((a.y() > place.y()) == (b.y() > place.y())) continue;
    const double x = a.x() + (place.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
    is_inside ^= x > place.x();
  }
  return is_inside;
}

}  // namespace

std::vector<RimEdge> rim_of(std::span<const Triangle> triangles) {
  std::vector<RimEdge> edges, rim;
  edges.reserve(3 * triangles.size());
  for (const auto& [a, b, c] : triangles)
    for (const RimEdge edge : {RimEdge{a, b}, RimEdge{b, c}, RimEdge{c, a}}) edges.push_back(edge);
  std::ranges::sort(edges);
  std::ranges::copy_if(edges, std::back_inserter(rim), [&](const RimEdge& edge) {
    return !std::ranges::binary_search(edges, RimEdge{edge[1], edge[0]});
  });
  return rim;
}

std::vector<Triangle> relief_triangles(const Front& front) {
  if (front.is_relief.empty()) return front.triangles;
  std::vector<Triangle> triangles;
  for (std::size_t t = 0; t < front.triangles.size(); ++t)
    if (front.is_relief[t]) triangles.push_back(front.triangles[t]);
  return triangles;
}

std::vector<std::uint8_t> relief_within(const Front& front, const Front& simpler,
                                        std::span<const Index> names) {
  const std::vector<RimEdge> rim = rim_of(relief_triangles(front));
  const std::vector<Kind> kinds = kinds_of(front, rim);
  std::vector<std::uint8_t> is_relief(simpler.triangles.size());
  parallel_for(is_relief.size(), [&](std::size_t t) {
    const Triangle& corners = simpler.triangles[t];
    bool has[4] = {};
    for (const Index i : corners)
      has[static_cast<std::size_t>(names[i] == no_index ? Kind::unknown : kinds[names[i]])] = true;
    if (has[0] != has[1]) {
      is_relief[t] = has[1];
      return;
    }
    const Vec3 sum = simpler.points[corners[0]] + simpler.points[corners[1]] + simpler.points[corners[2]];
    is_relief[t] = is_within(front, rim, sum.head<2>() / 3);
  });
  return is_relief;
}

Front relief_alone(const Front& front) {
  std::vector<Triangle> triangles = relief_triangles(front);
  cut_pinches(triangles, front.points.size());
  drop_specks(front, triangles);
  return front_of(front, std::move(triangles));
}

}  // namespace relievo
