#include "io/faces.h"

#include <algorithm>
#include <array>

#include "io/polygon.h"
#include "relievo/core/text.h"

namespace relievo::io {
namespace {

void add_triangle(std::int64_t a, std::int64_t b, std::int64_t c, std::vector<Triangle>& triangles) {
  if (a == b || b == c || c == a) return;
  triangles.push_back({static_cast<Index>(a), static_cast<Index>(b), static_cast<Index>(c)});
}

void add_strip(std::span<const std::int64_t> corners, std::vector<Triangle>& triangles) {
  std::size_t begin = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (corners[i] < 0) {
      begin = i + 1;
    } else if (i >= begin + 2) {
      const bool is_turned = (i - begin) % 2 == 1;
      const std::int64_t a = corners[i - 2], b = corners[i - 1];
      add_triangle(is_turned ? b : a, is_turned ? a : b, corners[i], triangles);
    }
  }
}

void add_polygon(std::span<const std::int64_t> corners, std::span<const Vec3> points,
                 std::vector<Triangle>& triangles) {
  const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
    add_triangle(corners[a], corners[b], corners[c], triangles);
  };
  if (corners.size() == 3) return add(0, 1, 2);
  // Most polygons have at most four corners; no memory is allocated for them.
  std::array<Vec3, 4> four;
  std::vector<Vec3> more(corners.size() > four.size() ? corners.size() : 0);
  const std::span<Vec3> polygon =
      more.empty() ? std::span(four).first(std::min(corners.size(), four.size())) : std::span(more);
  for (std::size_t i = 0; i < corners.size(); ++i) polygon[i] = points[static_cast<std::size_t>(corners[i])];
  for_each_triangle(polygon, add);
}

}  // namespace

bool add_face(std::span<const std::int64_t> corners, FaceKind kind, std::span<const Vec3> points,
              std::vector<Triangle>& triangles) {
  const std::int64_t least = kind == FaceKind::strip ? -1 : 0;
  const auto is_bad = [&](std::int64_t i) { return i < least || i >= std::ssize(points); };
  if (std::ranges::any_of(corners, is_bad)) return false;
  if (kind == FaceKind::strip) add_strip(corners, triangles);
  if (kind == FaceKind::polygon && corners.size() > 2) add_polygon(corners, points, triangles);
  for (std::size_t i = 2; kind == FaceKind::fan && i < corners.size(); ++i)
    add_triangle(corners[0], corners[i - 1], corners[i], triangles);
  return true;
}

std::string expected_corners(std::span<const std::int64_t> corners, std::span<const Vec3> points) {
  const auto is_bad = [&](std::int64_t i) { return i < -1 || i >= std::ssize(points); };
  const auto bad = std::ranges::find_if(corners, is_bad);
  const std::int64_t found = bad == corners.end() ? -1 : *bad;
  return cat("expected numbers of vertices below ", points.size(), ", found ", found);
}

Mesh mesh_over(const Cloud& cloud, std::vector<Triangle> triangles) {
  std::erase_if(triangles, [&](const Triangle& t) {
    return !std::ranges::all_of(t, [&](Index i) { return cloud.points[i].allFinite(); });
  });
  if (triangles.empty()) return {};
  Mesh mesh{cloud.points, std::move(triangles), {}, cloud.colours};
  for (Vec3& p : mesh.points)
    if (!p.allFinite()) p = Vec3::Zero();  // no triangle uses it
  if (!cloud.has_normals()) return mesh;
  mesh.corner_normals.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles)
    mesh.corner_normals.push_back({cloud.normals[a], cloud.normals[b], cloud.normals[c]});
  return mesh;
}

}  // namespace relievo::io
