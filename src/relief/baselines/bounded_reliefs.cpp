#include "relief/baselines/bounded_reliefs.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "relief/baselines/scaled.h"
#include "relief/edge_weight.h"
#include "relievo/relief/weights.h"
#include "scan/jumps.h"
#include "solver/bounded_fit.h"

namespace relievo {
namespace {

constexpr double tolerance = 1e-4;

// A part of the surface on which a finite-element problem is solved.
struct Sheet {
  std::vector<std::uint8_t> is_triangle;  // per triangle: whether it belongs to the sheet
  std::vector<std::uint8_t> is_fixed;     // per point: whether its height is 0
  bool is_flat = false;                   // true: elements are measured in the view plane; false: in space
};

// The area of a triangle, and half the cotangents of its angles. If an angle is very small, needle_share()
// reduces the half cotangents.
struct Element {
  std::array<double, 3> half_weight;
  double area;
};

Element element_of(const std::array<Vec3, 3>& p) {
  Element e{{}, (p[1] - p[0]).cross(p[2] - p[0]).norm() / 2};
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 u = p[(i + 1) % 3] - p[i], v = p[(i + 2) % 3] - p[i];
    e.half_weight[i] = .5 * u.dot(v) / std::max(2 * e.area, 1e-300);
  }
  const double share = needle_share(std::ranges::max(e.half_weight));
  for (double& weight : e.half_weight) weight *= share;
  return e;
}

// The free points of a sheet, and the least-squares problem of their heights.
struct SheetFit {
  std::vector<Index> unknown, free_points;  // per point: number of its unknown; per unknown: its point
  solver::BoundedFit fit;
};

SheetFit number_points(const Surface& surface, const Sheet& sheet) {
  SheetFit result{std::vector<Index>(surface.points.size(), no_index), {}, {}};
  for (std::size_t t = 0; t < sheet.is_triangle.size(); ++t)
    for (const Index i : surface.triangulation.triangles[t]) {
      if (!sheet.is_triangle[t] || sheet.is_fixed[i] || result.unknown[i] != no_index) continue;
      result.unknown[i] = static_cast<Index>(result.free_points.size());
      result.free_points.push_back(i);
      result.fit.positions.emplace_back(surface.points[i].head<2>());
    }
  return result;
}

// Returns the least-squares problem that fits heights so that each edge rises by rise(a, b) from point b to point a.
template <typename Rise>
SheetFit assemble(const Surface& surface, const Sheet& sheet, Rise&& rise) {
  SheetFit result = number_points(surface, sheet);
  const auto n = static_cast<int>(result.free_points.size());
  Eigen::VectorXd area = Eigen::VectorXd::Zero(n), load = Eigen::VectorXd::Zero(n);
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](Index from, Index to, double weight) {
    const auto row = static_cast<int>(result.unknown[from]), column = static_cast<int>(result.unknown[to]);
    if (result.unknown[from] == no_index) return;
    load[row] += weight * rise(from, to);
    entries.emplace_back(row, row, weight);
    if (result.unknown[to] != no_index && row > column) entries.emplace_back(row, column, -weight);
  };
  for (std::size_t t = 0; t < sheet.is_triangle.size(); ++t) {
    if (!sheet.is_triangle[t]) continue;
    const Triangle& corners = surface.triangulation.triangles[t];
    std::array<Vec3, 3> p;
    for (std::size_t i = 0; i < 3; ++i) p[i] = surface.points[corners[i]];
    for (Vec3& corner : p) corner.z() = sheet.is_flat ? 0 : corner.z();
    const Element e = element_of(p);
    for (std::size_t i = 0; i < 3; ++i) {
      const Index a = corners[(i + 1) % 3], b = corners[(i + 2) % 3];
      add(a, b, e.half_weight[i]), add(b, a, e.half_weight[i]);
      if (const Index own = result.unknown[corners[i]]; own != no_index) area[own] += e.area / 3;
    }
  }
  result.fit.A.resize(n, n);
  result.fit.A.setFromTriplets(entries.begin(), entries.end());
  result.fit.load = std::move(load), result.fit.mass = std::move(area);
  return result;
}

// Solves the problem for heights from 0 to `height`. Returns a height per point; points without an unknown
// get 0.
Result<std::vector<double>> solved(SheetFit sheet, double height) {
  std::vector<double> heights(sheet.unknown.size(), 0.0);
  const auto n = static_cast<Eigen::Index>(sheet.free_points.size());
  // A level surface has no slopes. Without this test, rounding errors of the solver would be scaled up to the
  // relief's height.
  if (n == 0 || sheet.fit.load.cwiseAbs().maxCoeff() <= 1e-9 * height) return heights;
  sheet.fit.lowest = Eigen::VectorXd::Zero(n), sheet.fit.highest = Eigen::VectorXd::Constant(n, height);
  RELIEVO_TRY(const solver::BoundedFitResult found, solver::minimise(sheet.fit, tolerance));
  for (std::size_t i = 0; i < sheet.free_points.size(); ++i)
    heights[sheet.free_points[i]] = found.x[static_cast<Eigen::Index>(i)];
  return heights;
}

// Sets the heights of free points that belong to no triangle of the sheet. Such a point shares triangles of
// the surface with points that have unknowns. It gets the height of the one of these points that is nearest
// in depth.
void fill_between(const Surface& surface, const std::vector<Index>& unknown, std::vector<double>& heights) {
  const std::vector<std::uint8_t>& is_fixed = surface.boundary.is_boundary;
  std::vector<double> nearest(heights.size(), std::numeric_limits<double>::infinity());
  for (std::size_t t = 0; t < surface.triangulation.triangles.size(); ++t)
    for (const Index i : surface.triangulation.triangles[t])
      for (const Index other : surface.triangulation.triangles[t]) {
        if (!surface.boundary.is_inside[t] || is_fixed[i] || unknown[i] != no_index ||
            unknown[other] == no_index)
          continue;
        const double distance = std::abs(surface.points[i].z() - surface.points[other].z());
        if (distance < nearest[i]) nearest[i] = distance, heights[i] = heights[other];
      }
}

}  // namespace

Result<std::vector<double>> mimicking_heights(const Surface& surface, double height) {
  Sheet sheet{surface.boundary.is_inside, surface.boundary.is_boundary};
  const std::vector<std::uint8_t> is_jump = jump_triangles(surface);
  for (std::size_t t = 0; t < is_jump.size(); ++t)
    if (is_jump[t]) sheet.is_triangle[t] = 0;
  SheetFit fit = assemble(surface, sheet,
                          [&](Index a, Index b) { return surface.points[a].z() - surface.points[b].z(); });
  const std::vector<Index> unknown = fit.unknown;
  RELIEVO_TRY(std::vector<double> heights, solved(std::move(fit), height));
  fill_between(surface, unknown, heights);
  return heights;
}

Result<std::vector<double>> bounded_heights(const Surface& surface, double height, double weight) {
  constexpr double steepest = 4;
  const auto slope = [&](Index i) {
    return compressed_slope(Vec3(surface.normals[i].cast<double>()), weight, steepest);
  };
  SheetFit fit = assemble(surface, {surface.boundary.is_inside, surface.boundary.is_boundary, true},
                          [&](Index a, Index b) {
                            const Vec2 step = (surface.points[a] - surface.points[b]).head<2>();
                            return (slope(a) + slope(b)).dot(step) / 2;
                          });
  fit.fit.mass.resize(0);  // no second derivatives: a membrane, not a thin plate
  return solved(std::move(fit), height);
}

}  // namespace relievo
