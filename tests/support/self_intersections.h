// Finds pairs of triangles where a solid intersects or touches itself. The arithmetic is exact for the
// single-precision coordinates that files store.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "relievo/core/text.h"
#include "relievo/plate/solid.h"
#include "support/big_integer.h"

namespace relievo::test {

using Corners = std::array<Vec3, 3>;

// Returns whether three points lie on a line that is parallel to an axis.
inline bool on_axis_line(const Vec3& a, const Vec3& b, const Vec3& c) {
  int common = 0;
  for (int k = 0; k < 3; ++k) common += a[k] == b[k] && a[k] == c[k];
  return common >= 2;
}

// Returns the sign of the determinant of b - a, c - a and d - a. It is 1 if the triangle abc is
// counter-clockwise as seen from d. In most cases in which the determinant is 0, this is found without exact
// arithmetic. In these cases, two points are equal, three points lie on a line parallel to an axis, or all
// points lie in a plane perpendicular to an axis.
inline int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  if (d == a || d == b || d == c || a == b || a == c || b == c) return 0;
  if (on_axis_line(a, b, c) || on_axis_line(a, b, d) || on_axis_line(a, c, d) || on_axis_line(b, c, d))
    return 0;
  for (int k = 0; k < 3; ++k)
    if (a[k] == b[k] && a[k] == c[k] && a[k] == d[k]) return 0;
  const Vec3 u = b - a, v = c - a, w = d - a;
  const double value = u.dot(v.cross(w));
  const auto product = [&](int i, int j) { return std::abs(v[i] * w[j]) + std::abs(v[j] * w[i]); };
  const double products =
      std::abs(u[0]) * product(1, 2) + std::abs(u[1]) * product(2, 0) + std::abs(u[2]) * product(0, 1);
  // The rounding error of `value` is below 8e-16 of the sum of the products' magnitudes (Shewchuk, 1997).
  if (std::abs(value) > 1e-15 * products) return value > 0 ? 1 : -1;
  const auto row = [&](const Vec3& p) {
    std::array<BigInteger, 3> exact;
    for (int k = 0; k < 3; ++k) exact[k] = BigInteger::scaled(p[k]) - BigInteger::scaled(a[k]);
    return exact;
  };
  const std::array p = row(b), q = row(c), r = row(d);
  return (p[0] * (q[1] * r[2] - q[2] * r[1]) + p[1] * (q[2] * r[0] - q[0] * r[2]) +
          p[2] * (q[0] * r[1] - q[1] * r[0]))
      .sign();
}

inline int orient2d(const Vec3& a, const Vec3& b, const Vec3& c, int drop) {
  // If the fourth point is above the plane of projection, the three-dimensional determinant equals the
  // two-dimensional one.
  Vec3 p = a, q = b, r = c, above = a;
  p[drop] = q[drop] = r[drop] = 0;
  above[drop] = 1;
  return orient3d(p, q, r, above);
}

// Returns whether the interiors of two coplanar triangles have a point in common.
inline bool overlap_in_plane(const Corners& s, const Corners& t) {
  int drop = 0;
  while (orient2d(s[0], s[1], s[2], drop) == 0) ++drop;
  const auto is_apart = [&](const Corners& from, const Corners& other) {
    const int turn = orient2d(from[0], from[1], from[2], drop);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto is_beyond = [&](const Vec3& p) {
        return turn * orient2d(from[i], from[(i + 1) % 3], p, drop) <= 0;
      };
      if (std::ranges::all_of(other, is_beyond)) return true;
    }
    return false;
  };
  return !is_apart(s, t) && !is_apart(t, s);
}

// Returns whether the segment pq meets the triangle or its boundary, without lying in the triangle's plane.
inline bool meets(const Vec3& p, const Vec3& q, const Corners& t) {
  if (orient3d(t[0], t[1], t[2], p) == orient3d(t[0], t[1], t[2], q)) return false;
  int least = 1, most = -1;
  for (std::size_t i = 0; i < 3; ++i) {
    const int side = orient3d(p, q, t[i], t[(i + 1) % 3]);
    least = std::min(least, side), most = std::max(most, side);
  }
  return least >= 0 || most <= 0;
}

// Returns whether an edge of s meets t. Edges that end in a common corner are not tested: if such an
// edge crosses t, the edge opposite the common corner, in s or in t, meets the other triangle, too.
inline bool edge_meets(const Corners& s, const Corners& t) {
  const auto is_common = [&](const Vec3& p) { return std::ranges::find(t, p) != t.end(); };
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 &p = s[i], &q = s[(i + 1) % 3];
    if (!is_common(p) && !is_common(q) && meets(p, q, t)) return true;
  }
  return false;
}

inline bool is_flat(const Corners& t) {
  for (int drop = 0; drop < 3; ++drop)
    if (orient2d(t[0], t[1], t[2], drop) != 0) return false;
  return true;
}

// Returns whether two triangles with positive areas share more than corners or an edge.
inline bool intersect(const Corners& s, const Corners& t) {
  if (std::ranges::all_of(t, [&](const Vec3& p) { return orient3d(s[0], s[1], s[2], p) == 0; }))
    return overlap_in_plane(s, t);
  return edge_meets(s, t) || edge_meets(t, s);
}

struct BoundedTriangle {
  Corners corners;
  Vec3 min, max;
  std::size_t index;

  bool overlaps(const Vec3& low, const Vec3& high) const {
    return (min.array() <= high.array()).all() && (low.array() <= max.array()).all();
  }
};

// A binary tree of bounding boxes of triangles. Each box is divided along its longest side. Building the
// tree changes the order of the triangles.
class BoxTree {
 public:
  explicit BoxTree(std::span<BoundedTriangle> triangles) : triangles_(triangles) {
    boxes_.resize(2 * triangles.size());
    if (!triangles.empty()) build(0, triangles.size());
  }

  // Calls f(j) for each triangle j > i whose bounding box overlaps that of triangle i.
  template <typename F>
  void for_overlapping(std::size_t i, F&& f) const {
    visit(0, triangles_.size(), i, f);
  }

 private:
  // The box of a range of at least two triangles is stored at index begin + end. No two such ranges have the same sum.
  static std::size_t slot(std::size_t begin, std::size_t end) { return begin + end; }

  void build(std::size_t begin, std::size_t end) {
    if (end - begin <= 1) return;
    Box box;
    for (std::size_t i = begin; i < end; ++i) box.extend(triangles_[i].min), box.extend(triangles_[i].max);
    boxes_[slot(begin, end)] = box;
    Eigen::Index axis = 0;
    box.size().maxCoeff(&axis);
    const std::size_t middle = (begin + end) / 2;
    const auto at = [&](std::size_t i) { return triangles_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(middle), at(end), [&](const BoundedTriangle& s, const BoundedTriangle& t) {
      return s.min[axis] + s.max[axis] < t.min[axis] + t.max[axis];
    });
    build(begin, middle), build(middle, end);
  }

  template <typename F>
  void visit(std::size_t begin, std::size_t end, std::size_t i, F& f) const {
    if (end <= i + 1) return;
    if (end - begin == 1) {
      if (triangles_[i].overlaps(triangles_[begin].min, triangles_[begin].max)) f(begin);
      return;
    }
    const Box& box = boxes_[slot(begin, end)];
    if (!triangles_[i].overlaps(box.min, box.max)) return;
    const std::size_t middle = (begin + end) / 2;
    visit(begin, middle, i, f), visit(middle, end, i, f);
  }

  std::span<BoundedTriangle> triangles_;
  std::vector<Box> boxes_;
};

// Returns the faults of a solid as stored in a file; an empty text if there are none. The text states how
// many triangles have no area, and how many pairs of triangles share more than a corner or an edge. One of
// these pairs is named.
inline std::string self_intersections(const Solid& solid) {
  std::vector<BoundedTriangle> triangles;
  std::size_t flat = 0, pairs = 0;
  std::string example;
  // The floats are stored in an array first, because g++ 12 drops the rounding of double(float(x)) when it vectorises.
  std::vector<Vec3f> stored;
  for (const Vec3& p : solid.points) stored.push_back(p.cast<float>());
  for (std::size_t i = 0; i < solid.triangles.size(); ++i) {
    const auto at = [&](Index p) { return Vec3(stored[p].cast<double>()); };
    const auto& [a, b, c] = solid.triangles[i];
    const Corners t{at(a), at(b), at(c)};
    if (is_flat(t)) {
      if (flat++ == 0) example += cat("; triangle ", i);
      continue;
    }
    triangles.push_back({t, t[0].cwiseMin(t[1]).cwiseMin(t[2]), t[0].cwiseMax(t[1]).cwiseMax(t[2]), i});
  }
  const BoxTree tree(triangles);
  for (std::size_t i = 0; i < triangles.size(); ++i)
    tree.for_overlapping(i, [&](std::size_t j) {
      if (intersect(triangles[i].corners, triangles[j].corners) && pairs++ == 0)
        example += cat("; triangles ", triangles[i].index, " and ", triangles[j].index);
    });
  return flat + pairs == 0 ? "" : cat(flat, " without an area, ", pairs, " pairs intersect", example);
}

}  // namespace relievo::test
