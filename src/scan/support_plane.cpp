#include "relievo/scan/support_plane.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/angle.h"
#include "core/quantile.h"
#include "core/random.h"
#include "geometry/plane.h"
#include "relievo/core/parallel.h"

namespace relievo {
namespace {

// Planes are tried with few points; the best plane is verified with more points.
constexpr std::size_t tried_points = 1024, judged_points = 16384;
// If a plane contains a twelfth of all points, one try in 1,728 draws three of its points. Then 6,000 tries
// miss the plane with probability 0.03.
constexpr std::size_t tries = 6000;
constexpr std::uint64_t seed = 20;
constexpr double first_tolerance =
    .01;  // share of the diagonal of the visible points' box; covers a depth camera's noise across a table
// The largest tolerance, as a share of the diagonal of the visible points' box. If the points are not concentrated
// near a plane, each fit widens the tolerance, until it exceeds this share and the plane is rejected.
constexpr double most_tolerance = .015;
constexpr int refinements = 6;
constexpr double widest_angle_deg = 30;  // between a plane's normal and those of its points, which are noisy
constexpr double least_share = .08;      // least share of points on the plane; smaller planes do not disturb
constexpr double least_figure = .02;     // least share of the points in front of a plane
// The most points behind the plane, as a share of all points that are not on it.
constexpr double most_behind = .1;
// At least this share of the points in front of the plane must be above the hull of the points on the plane.
constexpr double least_over = .7;
// The least height of a figure, as a share of the side of a square with the figure's area. Reliefs, medals and
// letters are lower.
constexpr double least_rise = .2;
// The least z of the plane's normal. A plane seen edge-on covers nothing.
constexpr double least_plane_facing = .1;
constexpr double steepest_table_deg =
    65;  // largest angle between a table's normal and "up" in the view; cameras look down on tables

struct Plane {
  Vec3 normal = Vec3::UnitZ();
  double offset = 0;
  double height(const Vec3& p) const { return normal.dot(p) - offset; }
};

struct Sample {
  std::vector<Vec3> points;
  std::vector<Vec3f> normals;
};

Sample sample_of(const Cloud& cloud, std::span<const Index> visible, std::size_t most) {
  Sample sample;
  const std::size_t count = std::min(most, visible.size());
  for (std::size_t i = 0; i < count; ++i) {
    const Index from = visible[i * visible.size() / count];
    sample.points.push_back(cloud.points[from]);
    sample.normals.push_back(cloud.normals[from]);
  }
  return sample;
}

bool fits(const Plane& plane, const Vec3f& normal) {
  static const double least = std::cos(to_radians(widest_angle_deg));
  return plane.normal.dot(normal.cast<double>()) >= least;
}

// Returns the plane through three points, if their normals fit the plane.
std::optional<Plane> plane_through(const Sample& sample, const std::array<std::size_t, 3>& of) {
  const Vec3 a = sample.points[of[0]];
  Vec3 n = (sample.points[of[1]] - a).cross(sample.points[of[2]] - a);
  const double length = n.norm();
  if (!(length > 0)) return std::nullopt;
  n /= n.z() < 0 ? -length : length;
  const Plane plane{n, n.dot(a)};
  if (n.z() < least_plane_facing) return std::nullopt;
  for (const std::size_t i : of)
    if (!fits(plane, sample.normals[i])) return std::nullopt;
  return plane;
}

// The numbers of points on a plane, in front of it and behind it.
struct SideCounts {
  std::size_t on = 0, before = 0, behind = 0;
  bool has_figure_before() const {
    const auto of = static_cast<double>(before + behind);
    return on > 0 && static_cast<double>(behind) <= most_behind * of;
  }
};

SideCounts sides_of(const Plane& plane, const Sample& sample, double tolerance) {
  SideCounts sides;
  for (std::size_t i = 0; i < sample.points.size(); ++i) {
    const double height = plane.height(sample.points[i]);
    if (height < -tolerance)
      ++sides.behind;
    else if (height <= tolerance && fits(plane, sample.normals[i]))
      ++sides.on;
    else if (height > tolerance)
      ++sides.before;
  }
  return sides;
}

// Tries planes that have nearly all other points in front of them. Returns the plane with the most points on
// it. The method is random sample consensus (Fischler and Bolles 1981), with normals as in Schnabel, Wahl and
// Klein 2007.
std::optional<Plane> best_plane(const Sample& sample, double tolerance) {
  struct Best {
    std::size_t on = 0;
    Plane plane;
  };
  const Best best = parallel_reduce(
      tries, Best{},
      [&](std::size_t begin, std::size_t end) {
        Best found;
        for (std::size_t t = begin; t < end; ++t) {
          SplitMix64 random(seed + 7 * t * SplitMix64::step);
          std::array<std::size_t, 3> of{};
          for (std::size_t& i : of)
            i = static_cast<std::size_t>(random.uniform() * static_cast<double>(sample.points.size()));
          const std::optional<Plane> plane = plane_through(sample, of);
          if (!plane) continue;
          const SideCounts sides = sides_of(*plane, sample, tolerance);
          if (sides.on > found.on && sides.has_figure_before()) found = {sides.on, *plane};
        }
        return found;
      },
      [](const Best& a, const Best& b) { return b.on > a.on ? b : a; }, 256);
  if (best.on == 0) return std::nullopt;
  return best.plane;
}

std::vector<std::size_t> points_on(const Plane& plane, const Sample& sample, double tolerance) {
  std::vector<std::size_t> on;
  for (std::size_t i = 0; i < sample.points.size(); ++i)
    if (std::abs(plane.height(sample.points[i])) <= tolerance && fits(plane, sample.normals[i]))
      on.push_back(i);
  return on;
}

// Returns the least-squares plane of the points `on`.
Plane fitted(const Sample& sample, const std::vector<std::size_t>& on) {
  Vec3 mean = Vec3::Zero();
  for (const std::size_t i : on) mean += sample.points[i];
  mean /= static_cast<double>(on.size());
  Mat3 covariance = Mat3::Zero();
  for (const std::size_t i : on)
    covariance += (sample.points[i] - mean) * (sample.points[i] - mean).transpose();
  Vec3 n = Eigen::SelfAdjointEigenSolver<Mat3>(covariance).eigenvectors().col(0);
  if (n.z() < 0) n = -n;
  return {n, n.dot(mean)};
}

// Returns the corners of the convex hull of points, counter-clockwise.
std::vector<Vec2> convex_hull(std::vector<Vec2> points) {
  std::ranges::sort(points, {}, [](const Vec2& p) { return std::pair(p.x(), p.y()); });
  std::vector<Vec2> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t first = hull.size();
    for (const Vec2& p : points) {
      const auto turns_right = [&] {
        const Vec2 u = hull.back() - hull[hull.size() - 2], v = p - hull.back();
        return cross(u, v) <= 0;
      };
      while (hull.size() >= first + 2 && turns_right()) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::ranges::reverse(points);
  }
  return hull;
}

// Returns the approximate area of points in a plane: the area of all grid cells that contain points.
double covered_area(const std::vector<Vec2>& points) {
  constexpr int side = 64;
  const Box box = Box::of(points);
  const double cell = box.longer_side() / side;
  if (!(cell > 0)) return 0;
  std::vector<std::uint8_t> is_covered(static_cast<std::size_t>(side * side), 0);
  for (const Vec2& p : points) {
    const Vec2 at = (p - box.min.head<2>()) / cell;
    const int x = std::min(static_cast<int>(at.x()), side - 1),
              y = std::min(static_cast<int>(at.y()), side - 1);
    is_covered[static_cast<std::size_t>(y * side + x)] = 1;
  }
  return cell * cell * static_cast<double>(std::ranges::count(is_covered, 1));
}

// Returns whether the points in front of the plane stand above the points on it and rise as high as a figure.
bool has_figure_over(const Plane& plane, const Sample& sample, const std::vector<std::size_t>& on,
                     double tolerance) {
  const Vec3 t1 = plane.normal.unitOrthogonal(), t2 = plane.normal.cross(t1);
  const auto along = [&](const Vec3& p) { return Vec2(t1.dot(p), t2.dot(p)); };
  std::vector<Vec2> floor, figure;
  for (const std::size_t i : on) floor.push_back(along(sample.points[i]));
  std::vector<double> rises;
  for (const Vec3& p : sample.points) {
    if (plane.height(p) <= tolerance) continue;
    figure.push_back(along(p));
    rises.push_back(plane.height(p));
  }
  const auto points = static_cast<double>(figure.size());
  if (points < least_figure * static_cast<double>(sample.points.size())) return false;
  const std::vector<Vec2> hull = convex_hull(std::move(floor));
  const auto over = std::ranges::count_if(figure, [&](const Vec2& p) { return is_within(p, hull); });
  if (static_cast<double>(over) < least_over * points) return false;
  return quantile(rises, .9) > least_rise * std::sqrt(covered_area(figure));
}

PlaneKind kind_of(const Plane& plane) {
  const Vec3& n = plane.normal;
  const bool is_level = n.y() > std::cos(to_radians(steepest_table_deg)) && std::abs(n.x()) < n.y();
  return is_level ? PlaneKind::table : PlaneKind::background;
}

}  // namespace

bool SupportPlane::takes(const Vec3& point, const Vec3f& point_normal) const {
  const Plane plane{normal, offset};
  const double height = plane.height(point);
  return height < -tolerance || (height <= tolerance && fits(plane, point_normal));
}

std::optional<SupportPlane> find_support_plane(const Cloud& viewed, std::span<const Index> visible,
                                               double rho) {
  constexpr std::size_t fewest = 100;
  if (!viewed.has_normals() || visible.size() < fewest) return std::nullopt;
  const Sample sample = sample_of(viewed, visible, judged_points);
  const double diagonal = Box::of(sample.points).diagonal();
  double tolerance = std::max(first_tolerance * diagonal, rho);
  const std::optional<Plane> first = best_plane(sample_of(viewed, visible, tried_points), tolerance);
  if (!first) return std::nullopt;
  Plane plane = *first;
  for (int round = 0; round < refinements; ++round) {
    const std::vector<std::size_t> on = points_on(plane, sample, tolerance);
    if (on.size() < 3 || tolerance > most_tolerance * diagonal) return std::nullopt;
    plane = fitted(sample, on);
    std::vector<double> off;
    for (const std::size_t i : on) off.push_back(std::abs(plane.height(sample.points[i])));
    // The tolerance is three standard deviations; 95 % of a normal distribution are within 1.96. A tolerance
    // computed from the median would leave half of a distant table, because the noise of depth cameras grows
    // with distance.
    tolerance = std::max(3 / 1.96 * quantile(off, .95), rho);
  }
  const std::vector<std::size_t> on = points_on(plane, sample, tolerance);
  const double share = static_cast<double>(on.size()) / static_cast<double>(sample.points.size());
  const bool is_found = plane.normal.z() >= least_plane_facing && share >= least_share &&
                        sides_of(plane, sample, tolerance).has_figure_before() &&
                        has_figure_over(plane, sample, on, tolerance);
  if (!is_found) return std::nullopt;
  return SupportPlane{kind_of(plane), plane.normal, plane.offset, tolerance, share};
}

}  // namespace relievo
