// Corner normals of a mesh. Declared in mesh.h, tested by tests/scan/mesh_test.cpp.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/angle.h"
#include "geometry/weld.h"
#include "relievo/core/parallel.h"
#include "relievo/scan/mesh.h"

namespace relievo {
namespace {

// Thousands of triangles may meet at the apex of a cone. An even sample of this size gives the same normal;
// comparing each with all the others would take quadratic time.
constexpr std::size_t enough_members = 512;

// The triangles around each position, and the angle of each one there.
struct VertexStars {
  struct Member {
    Index triangle;
    float angle;
  };
  std::vector<std::size_t> first;  // per position; the last element is the end
  std::vector<Member> members;
};

double angle_at(const Mesh& mesh, const Triangle& t, std::size_t corner) {
  const Vec3& p = mesh.points[t[corner]];
  const Vec3 a = mesh.points[t[(corner + 1) % 3]] - p, b = mesh.points[t[(corner + 2) % 3]] - p;
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

VertexStars find_stars(const Mesh& mesh, const std::vector<Index>& place) {
  VertexStars stars{std::vector<std::size_t>(mesh.points.size() + 1, 0), {}};
  for (const Triangle& t : mesh.triangles)
    for (const Index i : t) ++stars.first[place[i]];
  std::size_t sum = 0;
  for (std::size_t& at : stars.first) at = std::exchange(sum, sum + at);
  stars.members.resize(sum);
  std::vector<std::size_t> next(stars.first);
  for (Index t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t c = 0; c < 3; ++c) {
      const auto angle = static_cast<float>(angle_at(mesh, mesh.triangles[t], c));
      stars.members[next[place[mesh.triangles[t][c]]]++] = {t, angle};
    }
  return stars;
}

}  // namespace

std::vector<std::array<Vec3f, 3>> smooth_normals(const Mesh& mesh, double sharpest_deg) {
  const double least_cosine = std::cos(to_radians(sharpest_deg));
  const std::vector<Index> place = first_coincident(mesh.points);
  const VertexStars stars = find_stars(mesh, place);
  std::vector<Vec3f> flat(mesh.triangles.size());
  parallel_for(flat.size(), [&](std::size_t t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const Vec3 p = mesh.points[b] - mesh.points[a], q = mesh.points[c] - mesh.points[a];
    flat[t] = p.cross(q).stableNormalized().cast<float>();
  });
  std::vector<std::array<Vec3f, 3>> normals(flat.size());
  parallel_for(normals.size(), [&](std::size_t t) {
    for (std::size_t c = 0; c < 3; ++c) {
      const Index at = place[mesh.triangles[t][c]];
      Vec3 sum = Vec3::Zero();
      const std::size_t step = 1 + (stars.first[at + 1] - stars.first[at]) / enough_members;
      for (std::size_t m = stars.first[at]; m < stars.first[at + 1]; m += step) {
        const auto& [other, angle] = stars.members[m];
        if (static_cast<double>(flat[other].dot(flat[t])) < least_cosine) continue;
        sum += static_cast<double>(angle) * flat[other].cast<double>();
      }
      normals[t][c] = sum.stableNormalized().cast<float>();
    }
  });
  return normals;
}

}  // namespace relievo
