#include "relievo/plate/solid.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <span>
#include <utility>

#include "core/groups.h"
#include "plate/coincident_points.h"
#include "plate/front/thin_triangles.h"
#include "relievo/core/length.h"
#include "relievo/core/parallel.h"
#include "relievo/core/text.h"

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

// Directed edges, grouped by their lower vertex. An entry is twice the other vertex, plus 1 if the edge
// points to the lower vertex.
using EdgeTable = Groups<std::uint64_t, std::size_t>;

EdgeTable edge_table(const Solid& solid) {
  return grouped<std::uint64_t, std::size_t>(solid.points.size(), [&](auto&& add) {
    const auto add_edge = [&](Index a, Index b) {
      add(std::min(a, b), 2 * std::uint64_t{std::max(a, b)} + (a < b ? 0 : 1));
    };
    for (const auto& [a, b, c] : solid.triangles) add_edge(a, b), add_edge(b, c), add_edge(c, a);
  });
}

std::string wrong_edges(const Solid& solid) {
  EdgeTable table = edge_table(solid);
  for (std::size_t p = 0; p < solid.points.size(); ++p) {
    const std::span edges(table.items.begin() + static_cast<std::ptrdiff_t>(table.begin[p]),
                          table.begin[p + 1] - table.begin[p]);
    std::ranges::sort(edges);
    // In a closed surface the sorted entries form pairs: an edge from the lower vertex, then the opposite
    // edge. If an edge is used a third time, an entry has no partner.
    for (std::size_t i = 0; i < edges.size(); i += 2) {
      const bool is_pair = i + 1 < edges.size() && edges[i] % 2 == 0 && edges[i + 1] == edges[i] + 1;
      if (!is_pair)
        return cat("edge ", p, "-", edges[i] / 2,
                   " is not shared by exactly two triangles with opposite directions");
    }
  }
  return {};
}

std::string wrong_coincidence(const Solid& solid) {
  const auto pairs = find_coincident_points(solid);
  if (pairs.empty()) return {};
  return cat("points ", pairs[0][0], " and ", pairs[0][1], " are the same in single precision");
}

std::string wrong_volume(const Solid& solid) {
  const double volume = volume_mm3(solid);
  return volume > 0 ? "" : cat("the volume is ", volume, " mm3, not positive");
}

}  // namespace

std::string check_solid(const Solid& solid) {
  for (const auto check : {wrong_corners, wrong_edges, wrong_coincidence, wrong_volume})
    if (std::string wrong = check(solid); !wrong.empty()) return wrong;
  return {};
}

double volume_mm3(const Solid& solid) {
  if (solid.triangles.empty()) return 0;
  // Sums the signed volumes of tetrahedra with a common apex. The apex is a point of the solid. If it
  // were the origin, digits would cancel for solids far from the origin.
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

Solid in_unit(Solid solid, LengthUnit unit) {
  if (unit == std::exchange(solid.unit, unit)) return solid;
  const bool is_height_field = find_folds(solid).empty();  // some wrapped solids are no height fields
  const double scale = unit == LengthUnit::mm ? mm_per_inch : 1 / mm_per_inch;
  Box box;
  for (Vec3& p : solid.points) {
    p *= scale;
    box.extend(p);
  }
  if (is_height_field) unfold(solid);
  if (!box.is_empty()) separate_coincident(solid, box.centre().z());
  return solid;
}

}  // namespace relievo
