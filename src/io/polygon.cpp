// Triangulates by ear clipping. For any sequence of clipped triangles, the signed areas sum up to the
// polygon's area, and the winding numbers at any point sum up to the polygon's winding number. So if no
// triangle is turned over and the polygon does not intersect itself, the triangles cover its inside exactly
// once. Therefore the tests for ears need not be exact; they only help to find such a sequence.
#include "io/polygon.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "geometry/plane.h"
#include "relievo/core/text.h"

namespace relievo::io {
namespace {

// The largest magnitude that a triangle's negative area may have, as a share of the polygon's area. It is not
// 0, because files round collinear corners to floats.
constexpr double rounding = 1e-6;

// The largest number of corners of a non-convex polygon that is triangulated. It is limited, because the time
// is quadratic.
constexpr std::size_t most_corners = 10'000;

std::vector<std::array<Index, 3>> fan_of(std::size_t corners) {
  std::vector<std::array<Index, 3>> fan;
  for (Index i = 2; i < corners; ++i) fan.push_back({0, i - 1, i});
  return fan;
}

// Returns twice the vector area of the fan's triangle whose last corner is i.
Vec3 fan_area(std::span<const Vec3> corners, std::size_t i) {
  return (corners[i - 1] - corners[0]).cross(corners[i] - corners[0]);
}

Vec3 area_of(std::span<const Vec3> corners) {
  Vec3 area = Vec3::Zero();
  for (std::size_t i = 2; i < corners.size(); ++i) area += fan_area(corners, i);
  return area;
}

// Cuts ears off a counter-clockwise polygon in the plane.
class EarClipper {
 public:
  EarClipper(std::vector<Vec2> corners, double area)
      : at_(std::move(corners)),
        slack_(rounding * area),
        next_(at_.size()),
        before_(at_.size()),
        is_ear_(at_.size()) {
    const auto n = static_cast<Index>(at_.size());
    for (Index i = 0; i < n; ++i) next_[i] = (i + 1) % n, before_[i] = (i + n - 1) % n;
    for (Index i = 0; i < n; ++i)
      if (turn(i) <= 0) reflex_.push_back(i);
    for (Index i = 0; i < n; ++i) is_ear_[i] = turn(i) > 0 && is_empty(i);
  }

  // Returns the triangles; none if the polygon intersects itself.
  std::vector<std::array<Index, 3>> clip() {
    std::vector<std::array<Index, 3>> triangles;
    Index at = 0;
    for (std::size_t left = at_.size(); left > 2; --left) {
      const std::optional<Index> ear = find_ear(at, left);
      if (!ear) return {};
      triangles.push_back({before_[*ear], *ear, next_[*ear]});
      cut(*ear);
      at = next_[*ear];
    }
    return triangles;
  }

 private:
  // Returns twice the signed area of the triangle at corner i.
  double turn(Index i) const { return cross(at_[i] - at_[before_[i]], at_[next_[i]] - at_[before_[i]]); }

  // Returns the next ear. If there is none, returns a corner whose triangle has almost no area; if there is
  // no such corner, returns nothing.
  std::optional<Index> find_ear(Index from, std::size_t left) const {
    std::optional<Index> flat;
    for (std::size_t k = 0; k < left; ++k, from = next_[from]) {
      if (is_ear_[from]) return from;
      if (!flat && std::abs(turn(from)) <= slack_) flat = from;
    }
    return flat;
  }

  // Returns whether the triangle of a corner contains no other corner. Only reflex corners are tested,
  // because other corners cannot be inside unless the polygon intersects itself.
  bool is_empty(Index ear) const {
    const Vec2 &a = at_[before_[ear]], &b = at_[ear], &c = at_[next_[ear]];
    for (const Index i : reflex_) {
      const Vec2& p = at_[i];
      if (i == before_[ear] || i == next_[ear]) continue;
      const bool is_in =
          p == a   ? enters(i, b, c)
          : p == b ? enters(i, c, a)
          : p == c ? enters(i, a, b)
                   : cross(b - a, p - a) >= 0 && cross(c - b, p - b) >= 0 && cross(a - c, p - c) >= 0;
      if (is_in) return false;
    }
    return true;
  }

  // Returns whether an edge at corner i points into the angle between the directions to `right` and `left`.
  bool enters(Index i, const Vec2& right, const Vec2& left) const {
    const auto is_between = [&](const Vec2& q) {
      return cross(right - at_[i], q - at_[i]) > 0 && cross(q - at_[i], left - at_[i]) > 0;
    };
    return is_between(at_[next_[i]]) || is_between(at_[before_[i]]);
  }

  // Cuts the ear off. This changes only its two neighbours, so that only they can become ears.
  void cut(Index ear) {
    const Index before = before_[ear], next = next_[ear];
    next_[before] = next;
    before_[next] = before;
    std::erase_if(reflex_, [&](Index i) { return i == ear || ((i == before || i == next) && turn(i) > 0); });
    for (const Index i : {before, next}) is_ear_[i] = turn(i) > 0 && is_empty(i);
  }

  std::vector<Vec2> at_;
  double slack_;
  std::vector<Index> next_, before_;
  std::vector<bool> is_ear_;
  std::vector<Index> reflex_;  // remaining corners whose angle is 180 degrees or more
};

// Returns the corners projected onto the plane of their vector area, where they are counter-clockwise.
std::vector<Vec2> in_plane(std::span<const Vec3> corners, const Vec3& area) {
  const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(area, Vec3::UnitZ());
  std::vector<Vec2> flat;
  for (const Vec3& corner : corners) flat.push_back((turn * (corner - corners[0])).head<2>());
  return flat;
}

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
  // Most polygons have at most four corners; for them no memory is allocated.
  std::array<Vec3, 4> four;
  std::vector<Vec3> more(corners.size() > four.size() ? corners.size() : 0);
  const std::span<Vec3> polygon =
      more.empty() ? std::span(four).first(std::min(corners.size(), four.size())) : std::span(more);
  for (std::size_t i = 0; i < corners.size(); ++i) polygon[i] = points[static_cast<std::size_t>(corners[i])];
  for_each_triangle(polygon, add);
}

}  // namespace

bool fan_covers(std::span<const Vec3> corners) {
  const Vec3 area = area_of(corners);
  const double least = -rounding * area.squaredNorm();
  for (std::size_t i = 2; i < corners.size(); ++i)
    if (fan_area(corners, i).dot(area) < least) return false;  // a comparison with NaN is false
  return true;
}

std::vector<std::array<Index, 3>> triangulate(std::span<const Vec3> corners) {
  const Vec3 area = area_of(corners);
  if (corners.size() <= 3 || corners.size() > most_corners || !area.allFinite() || fan_covers(corners))
    return fan_of(corners.size());
  auto triangles = EarClipper(in_plane(corners, area), area.norm()).clip();
  return triangles.empty() ? fan_of(corners.size()) : triangles;
}

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
    if (!p.allFinite()) p = Vec3::Zero();  // no triangle uses this point
  if (!cloud.has_normals()) return mesh;
  mesh.corner_normals.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles)
    mesh.corner_normals.push_back({cloud.normals[a], cloud.normals[b], cloud.normals[c]});
  return mesh;
}

}  // namespace relievo::io
