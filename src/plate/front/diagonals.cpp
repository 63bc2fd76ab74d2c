#include "plate/front/diagonals.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace relievo {
namespace {

// The largest distance between the middles of a rectangle's diagonals, as a share of their length; it is not
// 0, because grid positions are rounded.
constexpr double rounding = 1e-6;

bool is_rectangle(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const double length = (c - a).norm();
  return (a + c - b - d).norm() < rounding * length && std::abs((d - b).norm() - length) < rounding * length;
}

}  // namespace

void turn_diagonals(std::span<const Vec2> points, std::span<const Vec2f> slopes, Triangulation& mesh) {
  // Returns how much the surface bends away from a straight line between two points.
  const auto bend = [&](Index a, Index b) {
    return std::abs((slopes[b] - slopes[a]).cast<double>().dot(points[b] - points[a]));
  };
  std::vector<std::uint8_t> is_turned(mesh.triangles.size(), 0);
  for (Index t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3 && !is_turned[t]; ++i) {
      const Index other = mesh.neighbours[t][i];
      if (other == no_index || other < t || is_turned[other]) continue;
      const Index apex = mesh.triangles[t][i], from = mesh.triangles[t][(i + 1) % 3],
                  to = mesh.triangles[t][(i + 2) % 3];
      const auto j = static_cast<std::size_t>(std::ranges::find(mesh.neighbours[other], t) -
                                              mesh.neighbours[other].begin());
      const Index opposite = mesh.triangles[other][j];
      if (!is_rectangle(points[from], points[opposite], points[to], points[apex])) continue;
      // A comparison with NaN is false, so that the diagonal stays.
      if (!(bend(apex, opposite) < bend(from, to))) continue;
      mesh.triangles[t] = {apex, from, opposite};
      mesh.triangles[other] = {opposite, to, apex};
      is_turned[t] = is_turned[other] = 1;
    }
}

}  // namespace relievo
