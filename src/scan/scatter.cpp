// Samples a whole mesh evenly. Declared in mesh.h, tested by tests/scan/mesh_test.cpp.
#include <Eigen/Geometry>
#include <cmath>

#include "core/angle.h"
#include "core/groups.h"
#include "core/srgb.h"
#include "geometry/weld.h"
#include "relievo/core/parallel.h"
#include "relievo/scan/mesh.h"

namespace relievo {
namespace {

std::vector<double> areas(const Mesh& mesh) {
  std::vector<double> areas(mesh.triangles.size());
  parallel_for(areas.size(), [&](std::size_t t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const Vec3 p = mesh.points[b] - mesh.points[a], q = mesh.points[c] - mesh.points[a];
    areas[t] = p.cross(q).norm() / 2;
  });
  return areas;
}

// Returns barycentric coordinates for point i. They come from the R2 sequence of Roberts (2018), which fills
// a square evenly, folded into the triangle. Its constants are 1 / p and 1 / p^2 for the plastic number p,
// the root of p^3 = p + 1.
Vec3f spread_weights(std::size_t i) {
  constexpr double first = 0.7548776662466927, second = 0.5698402909980532;
  double whole = 0;
  double u = std::modf(.5 + first * static_cast<double>(i + 1), &whole);
  double v = std::modf(.5 + second * static_cast<double>(i + 1), &whole);
  if (u + v > 1) u = 1 - u, v = 1 - v;
  return Vec3(1 - u - v, u, v).cast<float>();
}

void add(const Mesh& mesh, const std::array<Vec3f, 3>& normals, std::size_t t, const Vec3f& weights,
         Cloud& to) {
  Vec3 point = Vec3::Zero();
  Vec3f normal = Vec3f::Zero();
  for (int i = 0; i < 3; ++i) {
    const Index corner = mesh.triangles[t][static_cast<std::size_t>(i)];
    point += static_cast<double>(weights[i]) * mesh.points[corner];
    normal += weights[i] * normals[static_cast<std::size_t>(i)];
  }
  if (normal.isZero(0)) return;
  to.points.push_back(point);
  to.normals.push_back(normal.normalized());
  if (!mesh.colours.empty()) to.colours.push_back(weighted_mean(mesh.colours, mesh.triangles[t], weights));
}

// Thousands of triangles may meet at the apex of a cone. An even sample of this size gives the same normal.
// Comparing each triangle with all others would take quadratic time.
constexpr std::size_t enough_members = 512;

double angle_at(const Mesh& mesh, const Triangle& t, std::size_t corner) {
  const Vec3& p = mesh.points[t[corner]];
  const Vec3 a = mesh.points[t[(corner + 1) % 3]] - p, b = mesh.points[t[(corner + 2) % 3]] - p;
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

// Returns the triangle corners at each position; corner c of triangle t is 3 t + c.
Groups<Index, std::size_t> corners_at(const Mesh& mesh, const std::vector<Index>& place) {
  return grouped<Index, std::size_t>(mesh.points.size(), [&](auto&& add) {
    for (Index t = 0; t < mesh.triangles.size(); ++t)
      for (Index c = 0; c < 3; ++c) add(place[mesh.triangles[t][c]], 3 * t + c);
  });
}

}  // namespace

Cloud scatter(const Mesh& mesh, std::size_t points) {
  const std::vector<double> area = areas(mesh);
  double total = 0;
  for (const double a : area) total += a;
  Cloud cloud;
  if (!(total > 0) || !std::isfinite(total)) return cloud;
  const auto normals = mesh.corner_normals.empty() ? smooth_normals(mesh) : mesh.corner_normals;
  const double per_area = static_cast<double>(points) / total;
  double before = 0;
  std::size_t taken = 0;
  for (std::size_t t = 0; t < area.size(); ++t) {
    before += area[t];
    const auto due = static_cast<std::size_t>(before * per_area + .5);
    for (; taken < due; ++taken) add(mesh, normals[t], t, spread_weights(taken), cloud);
  }
  return cloud;
}

std::vector<std::array<Vec3f, 3>> smooth_normals(const Mesh& mesh, double sharpest_deg) {
  const double least_cosine = std::cos(to_radians(sharpest_deg));
  const std::vector<Index> place = first_coincident(mesh.points);
  const auto corners = corners_at(mesh, place);
  std::vector<Vec3f> flat(mesh.triangles.size());
  std::vector<std::array<float, 3>> angles(flat.size());
  parallel_for(flat.size(), [&](std::size_t t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const Vec3 p = mesh.points[b] - mesh.points[a], q = mesh.points[c] - mesh.points[a];
    flat[t] = p.cross(q).stableNormalized().cast<float>();
    for (std::size_t i = 0; i < 3; ++i)
      angles[t][i] = static_cast<float>(angle_at(mesh, mesh.triangles[t], i));
  });
  std::vector<std::array<Vec3f, 3>> normals(flat.size());
  parallel_for(normals.size(), [&](std::size_t t) {
    for (std::size_t c = 0; c < 3; ++c) {
      const auto around = corners[place[mesh.triangles[t][c]]];
      Vec3 sum = Vec3::Zero();
      for (std::size_t m = 0; m < around.size(); m += 1 + around.size() / enough_members) {
        const Index other = around[m] / 3;
        if (static_cast<double>(flat[other].dot(flat[t])) < least_cosine) continue;
        sum += static_cast<double>(angles[other][around[m] % 3]) * flat[other].cast<double>();
      }
      normals[t][c] = sum.stableNormalized().cast<float>();
    }
  });
  return normals;
}

}  // namespace relievo
