#include "plate/plate_ground.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/lists.h"
#include "geometry/edges.h"
#include "geometry/plane.h"
#include "geometry/weld.h"
#include "plate/front/silhouette.h"
#include "relievo/geometry/triangulation.h"

namespace relievo {
namespace {

constexpr double most_points = 2e5;  // largest number of points of the ground; a relief has about as many

// Returns whether three edges of length `step` from the point `from` are fine enough: none deviates from the
// deformed surface by more than refine() allows. Edges across a crease are ignored, because refine() splits
// them at the crease.
bool is_fine(const Deformation& deformation, const Vec3& from, double step, double tolerance_mm) {
  for (const Vec3& way : {Vec3(step, 0, 0), Vec3(0, step, 0), Vec3(.7 * step, .7 * step, 0)}) {
    const Vec3 to = from + way;
    if (deformation.crease_between && deformation.crease_between(from, to)) continue;
    const Vec3 middle = (deformation.at(from) + deformation.at(to)) / 2;
    if ((deformation.at(from + way / 2) - middle).norm() > share_of_edges * tolerance_mm) return false;
  }
  return true;
}

bool is_fine_within(const Deformation& deformation, std::span<const Vec2> polygon, double z, double step,
                    double tolerance_mm) {
  const Box box = Box::of(polygon);
  for (double y = box.min.y(); y < box.max.y(); y += step)
    for (double x = box.min.x(); x < box.max.x(); x += step)
      if (is_within({x + step, y + step}, polygon) && is_within({x, y}, polygon) &&
          !is_fine(deformation, {x, y, z}, step, tolerance_mm))
        return false;
  return true;
}

// A lattice of points in staggered rows, in which neighbours form equilateral triangles.
class StaggeredLattice {
 public:
  StaggeredLattice(std::span<const Vec2> polygon, double spacing)
      : spacing_(spacing), row_(spacing * std::sqrt(.75)) {
    const Box box = Box::of(polygon);
    min_ = box.min.head<2>();
    is_free_ = filled_image(2 + static_cast<int>(box.size().x() / spacing_),
                            1 + static_cast<int>(box.size().y() / row_), std::uint8_t{1});
  }

  // Removes the points within a circle, and those outside it by less than a third of the spacing.
  void clear(const Vec2& centre, double radius) {
    const double wide = radius + spacing_ / 3;
    const int first = row_of(centre.y() - wide), last = row_of(centre.y() + wide) + 1;
    for (int row = std::max(0, first); row <= std::min(is_free_.height - 1, last); ++row) {
      const double start = min_.x() + shift(row);
      const int left = static_cast<int>(std::max(0., std::floor((centre.x() - wide - start) / spacing_))),
                right = static_cast<int>(
                    std::min(is_free_.width - 1., std::ceil((centre.x() + wide - start) / spacing_)));
      for (int column = left; column <= right; ++column)
        if ((place(column, row) - centre).squaredNorm() < wide * wide) is_free_.at(column, row) = 0;
    }
  }

  // Returns the remaining points inside the polygon that are at least half the spacing from its sides.
  std::vector<Vec2> points_within(std::span<const Vec2> polygon) const {
    std::vector<Vec2> points;
    for (int row = 0; row < is_free_.height; ++row)
      for (int column = 0; column < is_free_.width; ++column)
        if (is_free_.at(column, row) && is_within(place(column, row), polygon, spacing_ / 2))
          points.push_back(place(column, row));
    return points;
  }

 private:
  int row_of(double y) const {
    return static_cast<int>(std::clamp(std::floor((y - min_.y()) / row_), -2., is_free_.height + 2.));
  }
  double shift(int row) const { return row % 2 == 0 ? 0 : spacing_ / 2; }
  Vec2 place(int column, int row) const { return min_ + Vec2(column * spacing_ + shift(row), row * row_); }
  double spacing_, row_;
  Vec2 min_;
  Image8 is_free_;
};

// Returns the Delaunay triangulation of the front's used points and the ground's points. Its indices count
// all points of the front first, including the unused ones, then the points of the ground.
std::vector<Triangle> triangulated(const HeightFieldMesh& front, const std::vector<Vec2>& ground) {
  const std::vector<std::uint8_t> is_used = used_points(front.points.size(), front.triangles);
  std::vector<Index> indices = indices_where(is_used.size(), [&](Index i) { return is_used[i] != 0; });
  std::vector<Vec2> points;
  for (const Index i : indices) points.emplace_back(front.points[i].head<2>());
  append(points, ground);
  for (std::size_t i = 0; i < ground.size(); ++i)
    indices.push_back(static_cast<Index>(front.points.size() + i));
  std::vector<Triangle> triangles = delaunay(points).triangles;
  for (Triangle& t : triangles)
    for (Index& i : t) i = indices[i];
  return triangles;
}

// Triangles that cover the polygon inside the rim. The relief's triangles come first, then those of the ground.
struct Cover {
  std::vector<Triangle> triangles;
  std::size_t relief = 0;  // the number of the relief's triangles
};

// Returns whether the triangles are a Delaunay triangulation. If four points lie on a common circle, both
// diagonals count as Delaunay.
bool is_delaunay(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles) {
  const auto at = [&](Index i) { return Vec2(points[i].head<2>()); };
  bool is_delaunay = true;
  each_edge(triangles, [&](std::span<const TriangleSide> sides) {
    if (sides.size() < 2) return;
    const auto [least, most] = std::ranges::minmax(sides, {}, &TriangleSide::apex);
    const Circle circle = circle_through(at(least.low()), at(least.high()), at(least.apex));
    is_delaunay &= !((at(most.apex) - circle.centre).norm() < (1 - 1e-6) * circle.radius);
  });
  return is_delaunay;
}

Cover joined(std::vector<Triangle> relief, const std::vector<Triangle>& ground) {
  Cover cover{std::move(relief), 0};
  cover.relief = cover.triangles.size();
  append(cover.triangles, ground);
  return cover;
}

// Combines the relief's triangles with those triangles of the triangulation that are ground, if the edges of
// both match. If these edges do not match although the relief is Delaunay, points on a common circle were
// triangulated differently; then the whole triangulation is returned. Returns nothing if the edges do not
// match and the relief is not Delaunay, or if a triangle connects a new point with a point above the ground.
std::optional<Cover> covered(const HeightFieldMesh& front, std::vector<Triangle> relief,
                             const std::vector<Triangle>& triangles, std::size_t rim_sides) {
  const double ground_z = front.points[front.hull[0]].z();
  std::vector<Triangle> ground, other;
  for (const Triangle& t : triangles) {
    const auto is_new = [&](Index i) { return i >= front.points.size(); };
    const auto is_level = [&](Index i) { return is_new(i) || front.points[i].z() == ground_z; };
    const bool is_ground = std::ranges::all_of(t, is_level);
    if (!is_ground && std::ranges::any_of(t, is_new)) return std::nullopt;
    (is_ground ? ground : other).push_back(t);
  }
  const bool may_differ = is_delaunay(front.points, relief);
  Cover cover = joined(std::move(relief), ground);
  if (boundary_edges(cover.triangles).size() == rim_sides) return cover;
  if (!may_differ) return std::nullopt;
  return joined(std::move(other), ground);
}

}  // namespace

double ground_spacing(const Deformation& deformation, std::span<const Vec2> polygon, double z,
                      double tolerance_mm) {
  const Vec3 size = Box::of(polygon).size();
  const double finest = std::sqrt(size.x() * size.y() / most_points);
  double spacing = std::min(size.head<2>().norm() / 4, deformation.min_feature_mm);
  while (spacing > finest && !is_fine_within(deformation, polygon, z, spacing, tolerance_mm)) spacing *= .8;
  return std::max(spacing, finest);
}

std::vector<Vec2> subdivided(std::span<const Vec2> polygon, double spacing) {
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &a = polygon[i], side = polygon[(i + 1) % polygon.size()] - a;
    const int steps = std::max(1, static_cast<int>(std::ceil(side.norm() / spacing)));
    points.push_back(a);
    for (int k = 1; k < steps; ++k) {
      const double share = static_cast<double>(k) / steps;
      points.emplace_back(a + share * side + convexity_offset(side, share));
    }
  }
  return points;
}

void fill_below(Solid& solid, const IndexPolygon& polygon, double spacing) {
  std::vector<Vec2> points;
  for (const Index i : polygon) points.emplace_back(solid.points[i].head<2>());
  const std::vector<Vec2> inner = StaggeredLattice(points, spacing).points_within(points);
  const auto first = static_cast<Index>(solid.points.size());
  const double z = solid.points[polygon[0]].z();
  for (const Vec2& p : inner) solid.points.emplace_back(p.x(), p.y(), z);
  append(points, inner);
  const auto n = static_cast<Index>(polygon.size());
  const auto to_solid = [&](Index i) { return i < n ? polygon[i] : first + i - n; };
  for (const auto& [a, b, c] : delaunay(points).triangles)
    solid.triangles.push_back({to_solid(a), to_solid(c), to_solid(b)});
}

IndexPolygon fill_ground(Solid& placed, const HeightFieldMesh& front, std::span<const Vec2> rim_inner,
                         double spacing) {
  const Vec2 shift = (placed.points[front.hull[0]] - front.points[front.hull[0]]).head<2>();
  std::vector<Vec2> ground;
  for (const Vec2& p : rim_inner) ground.push_back(p - shift);
  std::vector<Triangle> relief = placed.triangles;
  keep_where(relief, [&](std::size_t t) { return placed.regions[t] == Region::relief; });
  StaggeredLattice lattice(ground, spacing);
  for (const auto& [a, b, c] : relief) {
    const Circle circle =
        circle_through(front.points[a].head<2>(), front.points[b].head<2>(), front.points[c].head<2>());
    if (std::isfinite(circle.radius)) lattice.clear(circle.centre, circle.radius);
  }
  const std::vector<Vec2> inner = lattice.points_within(ground);
  append(ground, inner);

  auto cover = covered(front, relief, triangulated(front, ground), rim_inner.size());
  if (!cover) return {};
  placed.triangles = std::move(cover->triangles);
  placed.regions.assign(placed.triangles.size(), Region::ground);
  std::fill_n(placed.regions.begin(), cover->relief, Region::relief);
  IndexPolygon polygon;
  for (std::size_t i = 0; i < rim_inner.size(); ++i)
    polygon.push_back(static_cast<Index>(front.points.size() + i));
  const double ground_z = placed.points[front.hull[0]].z();
  for (std::size_t i = 0; i < ground.size(); ++i) {
    const Vec2 place = i < rim_inner.size() ? rim_inner[i] : Vec2(ground[i] + shift);
    placed.points.emplace_back(place.x(), place.y(), ground_z);
  }
  return polygon;
}

}  // namespace relievo
