// Makes fronts of plates whose shapes have closed forms, and measures outlines of plates.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "relievo/geometry/triangulation.h"
#include "relievo/plate/solid.h"
#include "support/results.h"

namespace relievo::test {

// A rectangle [0, width] x [0, height] of cells_x by cells_y cells, each divided into two triangles.
// grid_front() gives the inner points the heights z(x, y), and the points at the edge the height 0.
struct Grid {
  double width = 1, height = 1;
  int cells_x = 1, cells_y = 1;
};

inline void add_cells(const Grid& grid, HeightFieldMesh& front) {
  const auto at = [&](int i, int j) { return static_cast<Index>(j * (grid.cells_x + 1) + i); };
  for (int j = 0; j < grid.cells_y; ++j) {
    for (int i = 0; i < grid.cells_x; ++i) {
      front.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      front.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  for (int i = 0; i < grid.cells_x; ++i) front.hull.push_back(at(i, 0));
  for (int j = 0; j < grid.cells_y; ++j) front.hull.push_back(at(grid.cells_x, j));
  for (int i = grid.cells_x; i > 0; --i) front.hull.push_back(at(i, grid.cells_y));
  for (int j = grid.cells_y; j > 0; --j) front.hull.push_back(at(0, j));
}

inline HeightFieldMesh grid_front(const Grid& grid, const std::function<double(double, double)>& z) {
  HeightFieldMesh front;
  for (int j = 0; j <= grid.cells_y; ++j) {
    for (int i = 0; i <= grid.cells_x; ++i) {
      const double x = grid.width * i / grid.cells_x, y = grid.height * j / grid.cells_y;
      const bool is_rim = i == 0 || j == 0 || i == grid.cells_x || j == grid.cells_y;
      front.points.emplace_back(x, y, is_rim ? 0 : z(x, y));
    }
  }
  add_cells(grid, front);
  return front;
}

inline HeightFieldMesh flat_front(const Grid& grid) {
  return grid_front(grid, [](double, double) { return 0.0; });
}

// Divides a convex polygon with counter-clockwise corners into a fan of triangles at the height `ground_mm`.
// pyramid_front() instead connects the polygon's sides to an apex above its centre.
inline HeightFieldMesh fan_front(const std::vector<Vec2>& polygon, double ground_mm = 0) {
  HeightFieldMesh front{.ground_mm = ground_mm};
  for (Index i = 0; i < polygon.size(); ++i) {
    front.points.emplace_back(polygon[i].x(), polygon[i].y(), ground_mm);
    front.hull.push_back(i);
    if (i >= 2) front.triangles.push_back({0, i - 1, i});
  }
  return front;
}

inline HeightFieldMesh pyramid_front(const std::vector<Vec2>& polygon, double height) {
  HeightFieldMesh front = fan_front(polygon);
  front.triangles.clear();
  Vec2 centre = Vec2::Zero();
  for (const Vec2& p : polygon) centre += p / static_cast<double>(polygon.size());
  const auto n = static_cast<Index>(polygon.size());
  front.points.emplace_back(centre.x(), centre.y(), height);
  for (Index i = 0; i < n; ++i) front.triangles.push_back({i, (i + 1) % n, n});
  return front;
}

// Returns the Delaunay triangulation of points in the plane, with the points' heights.
inline HeightFieldMesh front_over(const std::vector<Vec3>& points) {
  std::vector<Vec2> plane;
  for (const Vec3& p : points) plane.push_back(p.head<2>());
  Triangulation mesh = delaunay(plane);
  return {points, std::move(mesh.triangles), std::move(mesh.hull)};
}

// Returns a plate with the given front. If making the plate fails, or if the plate is not closed, the test
// fails.
inline Solid plate_of(const HeightFieldMesh& front, const PlateOptions& options = {}) {
  Solid plate = value_of(make_plate(front, options));
  EXPECT_EQ(check_solid(plate), "");
  return plate;
}

// Returns an ellipse as a polygon with `n` corners. For the sizes that tests use, rounding leaves all corners convex.
inline std::vector<Vec2> ellipse(int n, double radius_x, double radius_y, double turn = 0) {
  std::vector<Vec2> polygon;
  for (int i = 0; i < n; ++i) {
    const double angle = turn + 2 * std::numbers::pi * i / n;
    polygon.emplace_back(radius_x * std::cos(angle), radius_y * std::sin(angle));
  }
  return polygon;
}

// Returns the Delaunay triangulation of a square grid of points, rotated by an angle. The heights are z(x, y)
// inside and 0 on the sides. Because of rounding, the sides are not exactly straight. Meshes that are sampled
// on a grid have such sides, too.
inline HeightFieldMesh turned_grid_front(int cells, double angle,
                                         const std::function<double(double, double)>& z) {
  std::vector<Vec3> points;
  for (int j = 0; j <= cells; ++j)
    for (int i = 0; i <= cells; ++i) {
      const Vec2 p = Eigen::Rotation2Dd(angle) * Vec2(.1 * i, .1 * j);
      const bool is_rim = i == 0 || j == 0 || i == cells || j == cells;
      points.emplace_back(p.x(), p.y(), is_rim ? 0 : z(.1 * i, .1 * j));
    }
  return front_over(points);
}

inline double polygon_area(const std::vector<Vec2>& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return twice / 2;
}

// Returns the distance of a point inside a convex polygon from the nearest side. Outside the
// polygon, the result is negative.
inline double depth_in(const std::vector<Vec2>& polygon, const Vec2& place) {
  double depth = 1e9;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 along = (polygon[(i + 1) % polygon.size()] - polygon[i]).normalized();
    const Vec2 to_place = place - polygon[i];
    depth = std::min(depth, along.x() * to_place.y() - along.y() * to_place.x());
  }
  return depth;
}

// Returns the bounding box of the points that triangles use.
inline Box used_box(const Solid& solid) {
  Box box;
  for (const Triangle& t : solid.triangles)
    for (const Index i : t) box.extend(solid.points[i]);
  return box;
}

// Returns whether a corner of the solid is nearer than `distance` to a point, as seen from above.
inline bool has_corner_at(const Solid& solid, const Vec2& place, double distance) {
  return std::ranges::any_of(solid.points,
                             [&](const Vec3& p) { return (p.head<2>() - place).norm() < distance; });
}

}  // namespace relievo::test
