#include "geometry/smooth_surface.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/groups.h"
#include "core/simd.h"
#include "geometry/plane.h"
#include "relievo/core/parallel.h"

namespace relievo {
namespace {

// Limits of the difference between the slope of a point and the mean slope of the triangles around the point:
// inside the surface, and at the surface's edge. The unit is the largest difference between the slope of one
// of these triangles and the mean, measured in the direction of the limited difference.
constexpr double most_over = 1.25, most_over_at_edges = 3;

Vec2 plane_slope(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 u = b - a, v = c - a;
  const double twice_area = cross(u.head<2>(), v.head<2>());
  if (!(twice_area > 0)) return Vec2::Zero();
  return Vec2(u.z() * v.y() - v.z() * u.y(), u.x() * v.z() - v.x() * u.z()) / twice_area;
}

// Four neighbours of a point. x and y are their positions relative to the point, in units of the distance
// from the point to its farthest neighbour. z is their height relative to the point.
struct FourHeights {
  Double4 x = {}, y = {}, z = {};
  Double4 is_there = {};  // 1, or 0 for an unused entry
};

// Fits x^2, x y, y^2, x and y, in this order, to heights around the origin by least squares. Nearer heights count
// more.
class Quadratic {
 public:
  RELIEVO_INLINE explicit Quadratic(std::span<const FourHeights> heights) {
    // Weighted sums of products. Each name lists the factors.
    Double4 xx{}, xy{}, yy{}, xxx{}, xxy{}, xyy{}, yyy{}, xxxx{}, xxxy{}, xxyy{}, xyyy{}, yyyy{};
    Double4 xz{}, yz{}, xxz{}, xyz{}, yyz{};
    for (const auto& [x, y, z, is_there] : heights) {
      const Double4 x_sq = x * x, y_sq = y * y, weight = is_there / (x_sq + y_sq + .05);
      const Double4 wx = weight * x, wy = weight * y, wxx = wx * x, wxy = wx * y, wyy = wy * y;
      xx += wxx, xy += wxy, yy += wyy, xz += wx * z, yz += wy * z;
      xxx += wxx * x, xxy += wxx * y, xyy += wyy * x, yyy += wyy * y;
      xxxx += wxx * x_sq, xxxy += wxy * x_sq, xxyy += wxx * y_sq, xyyy += wxy * y_sq, yyyy += wyy * y_sq;
      xxz += wxx * z, xyz += wxy * z, yyz += wyy * z;
    }
    const double mixed = total(xxyy), half_x = total(xxy), half_y = total(xyy);
    moments_ = {{{total(xxxx)},
                 {total(xxxy), mixed},
                 {mixed, total(xyyy), total(yyyy)},
                 {total(xxx), half_x, half_y, total(xx)},
                 {half_x, half_y, total(yyy), total(xy), total(yy)}}};
    products_ = {total(xxz), total(xyz), total(yyz), total(xz), total(yz)};
  }

  // Returns the coefficients of x and y. Solves by L D L^T. Computes only the last two unknowns, which are these
  // coefficients.
  Vec2 slope() const {
    std::array<std::array<double, terms>, terms> l = moments_;
    std::array<double, terms> d, rest = products_;
    // A small amount of bending energy keeps the system regular if all neighbours lie on two lines.
    for (std::size_t i = 0; i < 3; ++i) l[i][i] += 1e-3 * moments_[3][3] + 1e-12;
    for (std::size_t i = 0; i < terms; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        for (std::size_t k = 0; k < j; ++k)
          l[i][j] -= l[i][k] * l[j][k];  // l[i][k] still has the factor d[k]
        rest[i] -= l[i][j] / d[j] * rest[j];
      }
      for (std::size_t j = 0; j < i; ++j) {
        const double factor = l[i][j] / d[j];
        l[i][i] -= factor * l[i][j];
        l[i][j] = factor;
      }
      d[i] = l[i][i];
    }
    const double y = rest[4] / d[4];
    return {rest[3] / d[3] - l[4][3] * y, y};
  }

 private:
  static constexpr std::size_t terms = 5;
  std::array<std::array<double, terms>, terms> moments_{};  // symmetric; only the lower triangle is stored
  std::array<double, terms> products_{};
};

// Returns the slope, at the point `centre`, of the quadratic that passes through this point and best fits the
// neighbours. Returns `fallback` if there are too few neighbours. `heights` is scratch memory.
Vec2 fitted_slope(std::span<const Vec3> points, Index centre, std::span<const Index> neighbours,
                  const Vec2& fallback, std::vector<FourHeights>& heights) {
  if (neighbours.size() < 6) return fallback;
  double radius_sq = 0;
  for (const Index j : neighbours)
    radius_sq = std::max(radius_sq, (points[j] - points[centre]).head<2>().squaredNorm());
  const double unit = std::sqrt(radius_sq);
  if (!(unit > 0)) return fallback;
  heights.assign((neighbours.size() + 3) / 4, {});
  for (std::size_t k = 0; k < neighbours.size(); ++k) {
    const Vec3 step = points[neighbours[k]] - points[centre];
    FourHeights& four = heights[k / 4];
    four.x[k % 4] = step.x() / unit, four.y[k % 4] = step.y() / unit, four.z[k % 4] = step.z();
    four.is_there[k % 4] = 1;
  }
  const Vec2 slope = RELIEVO_WIDE(Quadratic(heights)).slope() / unit;
  return slope.allFinite() ? slope : fallback;
}

// Sorts the numbers in ascending order and removes repeated ones.
void leave_one_of_each(std::vector<Index>& numbers) {
  constexpr std::size_t slots = 256, most = slots / 2;
  if (numbers.size() <= most) {
    // A hash table removes most repeated numbers first, so that fewer have to be sorted.
    std::array<Index, slots> found;
    found.fill(no_index);
    std::erase_if(numbers, [&](Index number) {
      std::size_t slot = number * 2654435761U >> 24;
      while (found[slot] != no_index && found[slot] != number) slot = (slot + 1) % slots;
      return std::exchange(found[slot], number) == number;
    });
  }
  std::ranges::sort(numbers);
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

// Returns the barycentric weights of a place in the triangle a, b, s. If the place lies outside, negative weights
// become 0 and the others are scaled to the sum 1. If the triangle is too thin, returns the weights of the nearest
// place on the side a-b.
Vec3 weights_in(const Vec2& a, const Vec2& b, const Vec2& s, const Vec2& place) {
  const Vec2 side = b - a;
  const Vec3 areas =
      Vec3(cross(b - place, s - place), cross(s - place, a - place), cross(a - place, b - place)).cwiseMax(0);
  if (areas.sum() > 1e-12 * side.squaredNorm()) return areas / areas.sum();
  const double share =
      side.squaredNorm() > 0 ? std::clamp((place - a).dot(side) / side.squaredNorm(), 0.0, 1.0) : 0;
  return {1 - share, share, 0};
}

// Returns the difference between the slope at the midpoint of an edge and the mean of the slopes at its ends.
// `change` is the slope at the second end minus the slope at the first. The heights along the edge determine
// the component along the edge. To find the other component, we assume that the slope lies on the line
// through both end slopes, because most surfaces bend mainly in one direction. Thus a bend across rows of
// points does not depend on the triangulation between the rows.
template <typename Third>
Vec2 middle_deviation(const Third& t, const Vec2& edge, const Vec2& change) {
  // If `change` is nearly perpendicular to the edge, its component along the edge is unreliable. The result tends to
  // 0 where the square of this component is less than this share of the square of `change`.
  constexpr double least_along = .05;
  constexpr double most_share = 1.5;  // larger multiples of `change` are reduced, because they are noise
  const double along = 3 * ((t.ba - t.ab) / 2 - (t.ab - t.a) / 4 - (t.b - t.ba) / 4);
  const double change_along = change.dot(edge);
  const double divisor =
      change_along * change_along + least_along * change.squaredNorm() * edge.squaredNorm();
  if (!(divisor > 0)) return Vec2::Zero();
  const double share = along * change_along / divisor, excess = (share / most_share) * (share / most_share);
  return share / (1 + excess * excess) * change;
}

// Returns the middle Bezier point of a third. With it, the slope at the midpoint of the edge a-b deviates
// from the mean of the end slopes by middle_deviation().
template <typename Third>
double middle_point(const Third& t, const std::array<Vec2, 3>& corners, const Vec2& change) {
  const auto& [a, b, s] = corners;
  const Vec2 edge = b - a;
  // The position of s, projected onto the edge: 0 at a, 1 at b.
  const double foot = (s - a).dot(edge) / edge.squaredNorm();
  const double along_a = -(1 - foot), along_b = -foot;
  const double begin = along_a * t.a + along_b * t.ab + t.as, end = along_a * t.ba + along_b * t.b + t.bs;
  const double across = middle_deviation(t, edge, change).dot(s - a - foot * edge) / 3;
  return (begin + end) / 2 + 2 * across - along_a * t.ab - along_b * t.ba;
}

}  // namespace

SmoothSurface::SmoothSurface(std::span<const Vec3> points, std::span<const Triangle> triangles,
                             std::span<const std::uint8_t> is_smooth)
    : points_(points), triangles_(triangles), is_smooth_(is_smooth), slopes_(points.size(), Vec2::Zero()) {
  find_slopes();
}

// The triangles around a point, and the slopes of these triangles.
struct SmoothSurface::Fan {
  std::span<const Index> triangles;
  std::vector<Vec2>& slopes;
  Vec2 mean = Vec2::Zero();
  bool is_closed = false;  // whether the triangles enclose the point
};

// Limits a slope to slightly more than the range of the triangles' slopes. Slopes from the other side of a
// bend would make the surface oscillate beside the bend. If the triangles do not enclose the point, the
// point's slope is extrapolated and may exceed the range further.
Vec2 SmoothSurface::limited(const Vec2& slope, const Fan& fan) {
  const double off = (slope - fan.mean).norm();
  if (!(off > 0)) return slope;
  const Vec2 direction = (slope - fan.mean) / off;
  double farthest = 0;
  for (const Vec2& s : fan.slopes) farthest = std::max(farthest, direction.dot(s - fan.mean));
  return fan.mean + std::min(off, (fan.is_closed ? most_over : most_over_at_edges) * farthest) * direction;
}

// Returns, per point, whether the smooth triangles around the point do not enclose it. Counter-clockwise,
// each of these triangles has one corner after the point and one corner before the point. `balance` is the
// sum of the indices of the corners after the point, minus the sum of the indices of the corners before it.
// If a point is enclosed, each of its neighbours is counted once in each sum, so `balance` is 0.
std::vector<std::uint8_t> SmoothSurface::open_points() const {
  // Indices are hashed, because sums of plain indices would often be 0 by chance.
  const auto scattered = [](Index i) { return i * 2654435761U ^ i * 2654435761U >> 15; };
  std::vector<Index> balance(points_.size(), 0);
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    if (!is_smooth_[t]) continue;
    const auto& [a, b, c] = triangles_[t];
    const Index of_a = scattered(a), of_b = scattered(b), of_c = scattered(c);
    balance[a] += of_b - of_c, balance[b] += of_c - of_a, balance[c] += of_a - of_b;
  }
  std::vector<std::uint8_t> is_open(balance.size());
  for (std::size_t i = 0; i < balance.size(); ++i) is_open[i] = balance[i] != 0;
  return is_open;
}

void SmoothSurface::find_slopes() {
  const auto around = grouped<Index>(points_.size(), [&](auto&& add) {
    for (Index t = 0; t < triangles_.size(); ++t)
      if (is_smooth_[t])
        for (const Index i : triangles_[t]) add(i, t);
  });
  const std::vector<std::uint8_t> is_open = open_points();
  const auto add_ring = [&](Index i, std::vector<Index>& ring) {
    for (const Index t : around[i]) {
      const auto& [a, b, c] = triangles_[t];
      ring.push_back(i == a ? b : i == b ? c : a);
      if (is_open[i]) ring.push_back(i == a ? c : i == b ? a : b);
    }
  };
  parallel_ranges(points_.size(), 1024, [&](std::size_t begin, std::size_t end) {
    std::vector<Index> near, all;
    std::vector<Vec2> slopes;
    std::vector<FourHeights> heights;
    for (auto i = static_cast<Index>(begin); i < end; ++i) {
      if (around[i].empty()) continue;
      near.clear();
      add_ring(i, near);
      leave_one_of_each(near);
      all = near;
      for (const Index j : near) add_ring(j, all);
      leave_one_of_each(all);
      std::erase(all, i);
      Fan fan{around[i], slopes};
      fan.is_closed = !is_open[i];
      measure(fan);
      slopes_[i] = limited(fitted_slope(points_, i, all, fan.mean, heights), fan);
    }
  });
}

// Computes the slopes of the triangles, and their mean.
void SmoothSurface::measure(Fan& fan) const {
  fan.slopes.clear();
  double areas = 0;
  for (const Index t : fan.triangles) {
    const auto& [a, b, c] = triangles_[t];
    fan.slopes.push_back(plane_slope(points_[a], points_[b], points_[c]));
    const double area = cross((points_[b] - points_[a]).head<2>(), (points_[c] - points_[a]).head<2>());
    fan.mean += area * fan.slopes.back();
    areas += area;
  }
  if (areas > 0) fan.mean /= areas;
}

// The Bezier points of the three cubics over a triangle. Cubic i covers the third between the centre and the
// side opposite to corner i.
struct SmoothSurface::Element {
  std::array<Vec2, 3> corners;
  Vec2 centre;
  std::array<Third, 3> thirds;
  std::array<double, 3> near_centre;  // points next to the centre, on the lines to the corners
  double at_centre;
};

SmoothSurface::Element SmoothSurface::element(Index t) const {
  const Triangle& numbers = triangles_[t];
  Element e;
  std::array<double, 3> z, to_centre;
  for (std::size_t i = 0; i < 3; ++i)
    e.corners[i] = points_[numbers[i]].head<2>(), z[i] = points_[numbers[i]].z();
  const auto& p = e.corners;
  e.centre = (p[0] + p[1] + p[2]) / 3;
  for (std::size_t i = 0; i < 3; ++i) to_centre[i] = z[i] + slopes_[numbers[i]].dot(e.centre - p[i]) / 3;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t a = (i + 1) % 3, b = (i + 2) % 3;
    Third& third = e.thirds[i];
    third = {z[a],
             z[b],
             z[a] + slopes_[numbers[a]].dot(p[b] - p[a]) / 3,
             z[b] + slopes_[numbers[b]].dot(p[a] - p[b]) / 3,
             to_centre[a],
             to_centre[b],
             0};
    third.abs = middle_point(third, {p[a], p[b], e.centre}, slopes_[numbers[b]] - slopes_[numbers[a]]);
  }
  for (std::size_t i = 0; i < 3; ++i)
    e.near_centre[i] = (to_centre[i] + e.thirds[(i + 1) % 3].abs + e.thirds[(i + 2) % 3].abs) / 3;
  e.at_centre = (e.near_centre[0] + e.near_centre[1] + e.near_centre[2]) / 3;
  return e;
}

SmoothSurface::Sample SmoothSurface::at(Index t, const Vec2& place) const {
  const Vec3 &p0 = points_[triangles_[t][0]], &p1 = points_[triangles_[t][1]],
             &p2 = points_[triangles_[t][2]];
  const double twice_area = cross((p1 - p0).head<2>(), (p2 - p0).head<2>());
  if (!is_smooth_[t] || !(twice_area > 0)) {
    const Vec2 slope = plane_slope(p0, p1, p2);
    return {p0.z() + slope.dot(place - p0.head<2>()), slope};
  }
  const Element e = element(t);
  const auto& p = e.corners;
  // `place` lies in the third of the triangle that is opposite to the corner with the least weight.
  std::array<double, 3> weight;
  for (std::size_t k = 0; k < 3; ++k) weight[k] = cross(p[(k + 1) % 3] - place, p[(k + 2) % 3] - place);
  const auto i = static_cast<std::size_t>(std::ranges::min_element(weight) - weight.begin());
  const std::size_t a = (i + 1) % 3, b = (i + 2) % 3;
  return de_casteljau(e.thirds[i], {e.near_centre[a], e.near_centre[b], e.at_centre},
                      weights_in(p[a], p[b], e.centre, place), {p[a], p[b], e.centre});
}

// Evaluates one cubic by de Casteljau's algorithm: the cubic's points give six points of a quadratic, these
// give three points of a plane, and the plane gives height and slope. `inner` are the cubic's Bezier points
// next to the centre, on the lines from a and b, and the one at the centre.
SmoothSurface::Sample SmoothSurface::de_casteljau(const Third& t, const Vec3& inner, const Vec3& share,
                                                  const std::array<Vec2, 3>& corners) {
  const double u = share.x(), v = share.y(), w = share.z();
  const double aa = u * t.a + v * t.ab + w * t.as, bb = u * t.ba + v * t.b + w * t.bs, ss = share.dot(inner);
  const double ab = u * t.ab + v * t.ba + w * t.abs, as = u * t.as + v * t.abs + w * inner.x(),
               bs = u * t.abs + v * t.bs + w * inner.y();
  const double fa = u * aa + v * ab + w * as, fb = u * ab + v * bb + w * bs, fs = u * as + v * bs + w * ss;
  const auto at = [&](std::size_t i, double z) { return Vec3(corners[i].x(), corners[i].y(), z); };
  return {u * fa + v * fb + w * fs, 3 * plane_slope(at(0, fa), at(1, fb), at(2, fs))};
}

}  // namespace relievo
