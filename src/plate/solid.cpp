#include "relievo/plate/solid.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <span>
#include <utility>

#include "relievo/core/parallel.h"
#include "relievo/core/text.h"
#include "twins.h"

namespace relievo {
namespace {

std::string name(const char* kind, std::size_t i) {
  return cat(kind, " ", i);
}

std::string wrong_corners(const Solid& solid) {
  if (solid.front_triangles > solid.triangles.size()) return "more front triangles than triangles";
  for (std::size_t t = 0; t < solid.triangles.size(); ++t) {
    const auto& [a, b, c] = solid.triangles[t];
    if (std::max({a, b, c}) >= solid.points.size())
      return name("triangle", t) + " has a corner that does not exist";
    if (a == b || b == c || c == a) return name("triangle", t) + " has two equal corners";
    for (const Index i : {a, b, c})
      if (!solid.points[i].allFinite()) return name("point", i) + " is not finite";
  }
  return {};
}

// Directed edges, those of a vertex together at its lower end: the other end, and the direction in the lowest
// bit.
struct EdgeTable {
  std::vector<std::size_t> begin;  // per point, and one more
  std::vector<std::uint64_t> edges;
};

EdgeTable edge_table(const Solid& solid) {
  EdgeTable table{std::vector<std::size_t>(solid.points.size() + 1), {}};
  const auto each_edge = [&](auto&& f) {
    for (const auto& [a, b, c] : solid.triangles) f(a, b), f(b, c), f(c, a);
  };
  table.edges.resize(3 * solid.triangles.size());
  each_edge([&](Index a, Index b) { ++table.begin[std::min(a, b)]; });
  std::size_t sum = 0;
  for (std::size_t& at : table.begin) at = std::exchange(sum, sum + at);
  std::vector<std::size_t> next(table.begin);
  each_edge([&](Index a, Index b) {
    const std::uint64_t other = std::max(a, b);
    table.edges[next[std::min(a, b)]++] = 2 * other + (a < b ? 0 : 1);
  });
  return table;
}

std::string wrong_edges(const Solid& solid) {
  EdgeTable table = edge_table(solid);
  for (std::size_t p = 0; p < solid.points.size(); ++p) {
    const std::span edges(table.edges.begin() + static_cast<std::ptrdiff_t>(table.begin[p]),
                          table.begin[p + 1] - table.begin[p]);
    std::ranges::sort(edges);
    // In order, good edges are pairs: the same other end, forward, then backward. A third use breaks the
    // pairs.
    for (std::size_t i = 0; i < edges.size(); i += 2) {
      const bool is_pair = i + 1 < edges.size() && edges[i] % 2 == 0 && edges[i + 1] == edges[i] + 1;
      if (!is_pair)
        return cat("edge ", p, "-", edges[i] / 2,
                   " is not shared by exactly two triangles with opposite directions");
    }
  }
  return {};
}

std::string wrong_twins(const Solid& solid) {
  const auto twins = find_twins(solid);
  if (twins.empty()) return {};
  return cat("points ", twins[0][0], " and ", twins[0][1], " are the same in single precision");
}

std::string wrong_volume(const Solid& solid) {
  const double volume = volume_mm3(solid);
  return volume > 0 ? "" : cat("the volume is ", volume, " mm3, not positive");
}

}  // namespace

std::string check_solid(const Solid& solid) {
  for (const auto check : {wrong_corners, wrong_edges, wrong_twins, wrong_volume})
    if (std::string wrong = check(solid); !wrong.empty()) return wrong;
  return {};
}

double volume_mm3(const Solid& solid) {
  if (solid.triangles.empty()) return 0;
  // Cones to a point of the solid: far from the origin, cones to the origin would cancel digits.
  const Vec3 apex = solid.points[solid.triangles[0][0]];
  return parallel_reduce(
      solid.triangles.size(), 0.0,
      [&](std::size_t begin, std::size_t end) {
        double sum = 0;
        for (std::size_t t = begin; t < end; ++t) {
          const auto& [a, b, c] = solid.triangles[t];
          const Vec3 p = solid.points[a] - apex, q = solid.points[b] - apex, r = solid.points[c] - apex;
          sum += p.dot(q.cross(r)) / 6;
        }
        return sum;
      },
      std::plus<>());
}

}  // namespace relievo
