#include "relief/stroke_fields.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/disjoint_sets.h"
#include "core/lists.h"
#include "geometry/neighbours.h"
#include "geometry/outline_union.h"
#include "relievo/core/parallel.h"
#include "scan/jumps.h"
#include "scan/surface_blur.h"

namespace relievo {
namespace {

double distance_to_segment_sq(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a;
  const double length_sq = along.squaredNorm();
  const double t = length_sq > 0 ? std::clamp((p - a).dot(along) / length_sq, 0.0, 1.0) : 0;
  return (p - a - t * along).squaredNorm();
}

// A polyline, divided into pieces of a few corners. A point is compared only with pieces whose box is near it.
class Line {
 public:
  explicit Line(std::span<const Vec3> corners) : corners_(corners) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (i % piece == 0) boxes_.emplace_back();
      // A piece also contains the segment that ends at its first corner.
      for (const Vec3& end : {corners[i], corners[i == 0 ? 0 : i - 1]}) boxes_.back().extend(end);
    }
  }

  // Returns the square of a point's distance from the line, but at most `most_sq`.
  double distance_sq(const Vec3& p, double most_sq) const {
    double least = most_sq;
    for (std::size_t k = 0; k < boxes_.size(); ++k) {
      const Vec3 outside = (boxes_[k].min - p).cwiseMax(p - boxes_[k].max).cwiseMax(0);
      if (outside.squaredNorm() >= least) continue;
      const std::size_t end = std::min(corners_.size(), (k + 1) * piece);
      for (std::size_t i = k * piece; i < end; ++i)
        least = std::min(least, distance_to_segment_sq(p, corners_[i == 0 ? 0 : i - 1], corners_[i]));
    }
    return least;
  }

 private:
  static constexpr std::size_t piece = 8;

  std::span<const Vec3> corners_;
  std::vector<Box> boxes_;  // one per piece
};

// Returns the points and distances of `all` for which is_kept(i) is true; i is the index in the lists.
template <typename IsKept>
StrokePoints kept(const StrokePoints& all, IsKept&& is_kept) {
  const std::vector<Index> some = indices_where(all.points.size(), is_kept);
  return {pick(all.points, some), pick(all.distances, some)};
}

StrokePoints points_near(const Surface& surface, std::span<const Vec3> line, double radius) {
  Box box;
  for (const Vec3& p : line) box.extend(p);
  const Vec3 least = box.min.array() - radius, most = box.max.array() + radius;
  std::vector<Index> in_box;
  for (Index i = 0; i < surface.points.size(); ++i) {
    const Vec3& p = surface.points[i];
    if ((p.array() < least.array()).any() || (p.array() > most.array()).any()) continue;
    if (!surface.boundary.is_boundary[i]) in_box.push_back(i);
  }
  const Line pieces(line);
  std::vector<double> distances(in_box.size());
  const auto measure = [&](std::size_t k) {
    distances[k] = std::sqrt(pieces.distance_sq(surface.points[in_box[k]], radius * radius));
  };
  parallel_for(in_box.size(), measure, 256);
  return kept({in_box, distances}, [&](Index k) { return distances[k] < radius; });
}

// Calls f(a, b) for each triangle side from a to b inside the relief, if is_wanted(a, b) and the side does
// not cross a depth jump.
template <typename IsWanted, typename F>
void each_link(const Surface& surface, IsWanted&& is_wanted, F&& f) {
  each_side_inside(surface, [&](Index a, Index b) {
    if (is_wanted(a, b) && !is_jump(surface, a, b)) f(a, b);  // is_jump() comes last, because it takes longer
  });
}

// Returns the connected components of the given points; each_link() gives the edges.
DisjointSets connected(const Surface& surface, std::span<const Index> points) {
  const std::vector<Index> number = places_in(points, surface.points.size());
  DisjointSets sets(points.size());
  each_link(
      surface, [&](Index a, Index b) { return number[a] != no_index && number[b] != no_index; },
      [&](Index a, Index b) { sets.join(number[a], number[b]); });
  return sets;
}

StrokePoints points_at_line(const Surface& surface, std::span<const Vec3> line, double radius) {
  const StrokePoints near = points_near(surface, line, radius);
  DisjointSets sets = connected(surface, near.points);
  const double touching = std::max(2 * surface.rho, radius / 4);
  std::vector<std::uint8_t> is_touched(near.points.size(), 0);
  for (Index i = 0; i < near.points.size(); ++i)
    if (near.distances[i] <= touching) is_touched[sets.find(i)] = 1;
  return kept(near, [&](Index i) { return is_touched[sets.find(i)] != 0; });
}

// A lasso seen along its direction, in coordinates whose z axis points towards the viewer.
class SeenLasso {
 public:
  SeenLasso(std::span<const Vec3> corners, const Vec3& to_viewer)
      : turn_(Eigen::Quaterniond::FromTwoVectors(to_viewer, Vec3::UnitZ()).toRotationMatrix()),
        to_viewer_(to_viewer) {
    Box box;
    for (const Vec3& corner : corners) box.extend(turn_ * corner);
    for (const Vec3& corner : corners) {
      rim_.push_back(flat(turn_ * corner));
      outline_[0].push_back(rim_.back().head<2>());
    }
    rim_.push_back(rim_[0]);
    low_ = box.min, high_ = box.max;
    deepest_ = low_.z() - box.longer_side() / 2;
  }

  bool has(const Vec3& p, const Vec3f& normal) const {
    const Vec3 q = turn_ * p;
    if ((q.head<2>().array() < low_.head<2>().array()).any()) return false;
    if ((q.head<2>().array() > high_.head<2>().array()).any()) return false;
    if (q.z() < deepest_ || !(normal.cast<double>().dot(to_viewer_) > 0)) return false;
    return winding_number(outline_, q.head<2>()) != 0;
  }

  Vec3 seen(const Vec3& p) const { return flat(turn_ * p); }
  std::span<const Vec3> rim() const { return rim_; }

 private:
  static Vec3 flat(const Vec3& q) { return {q.x(), q.y(), 0}; }

  Mat3 turn_;
  Vec3 to_viewer_, low_, high_;
  double deepest_ = 0;
  std::vector<Vec3> rim_;  // first corner repeated at the end
  Outlines outline_ = Outlines(1);
};

StrokePoints points_in_lasso(const Surface& surface, const SeenLasso& lasso, double radius) {
  std::vector<double> distances(surface.points.size(), -1);
  const Line rim(lasso.rim());
  parallel_for(distances.size(), [&](std::size_t i) {
    const Vec3& p = surface.points[i];
    if (!surface.boundary.is_boundary[i] && lasso.has(p, surface.normals[i]))
      distances[i] = radius - std::sqrt(rim.distance_sq(lasso.seen(p), radius * radius));
  });
  std::vector<Index> inside = indices_where(distances.size(), [&](Index i) { return distances[i] >= 0; });
  distances = pick(distances, inside);
  return {std::move(inside), std::move(distances)};
}

// Returns how fast the surface turns at each point, in degrees per 1 % of the longer side. The rate is the
// angle between the normals of neighbouring points over their distance, as a root mean square. The factor
// sqrt(2) turns this mean into the rate across a crease, because a crease turns in one direction only. The
// normals are blurred to remove noise.
std::vector<float> turning_of(const Surface& surface) {
  constexpr double width = .008, least_width_rho = 1.5;
  const double side = surface.longer_side();
  std::vector<Vec2f> xy(surface.points.size()), z(xy.size());
  for (std::size_t i = 0; i < xy.size(); ++i) {
    xy[i] = surface.normals[i].head<2>();
    z[i] = Vec2f(surface.normals[i].z(), 0);
  }
  const SurfaceBlur blur(surface.points, std::max(width * side, least_width_rho * surface.rho));
  for (std::vector<Vec2f>* part : {&xy, &z}) blur.apply(*part);
  const auto normal = [&](Index i) {
    return Vec3(Vec3f(xy[i].x(), xy[i].y(), z[i].x()).cast<double>().normalized());
  };
  std::vector<double> angles(xy.size(), 0),
      lengths(xy.size(), 0);  // sums of squares; units: degrees, % of the longer side
  const auto all = [](Index, Index) { return true; };
  each_link(surface, all, [&](Index a, Index b) {
    const double angle =
        2 * std::asin(std::min(1., (normal(a) - normal(b)).norm() / 2)) * 180 / std::numbers::pi;
    const double length = (surface.points[a] - surface.points[b]).norm() / side * 100;
    for (const Index end : {a, b}) angles[end] += angle * angle, lengths[end] += length * length;
  });
  std::vector<float> turning(xy.size(), 0);
  for (std::size_t i = 0; i < turning.size(); ++i)
    if (lengths[i] > 0) turning[i] = static_cast<float>(std::sqrt(2 * angles[i] / lengths[i]));
  return turning;
}

// Returns the points of the region that have an edge to a point outside of it. Edges across depth jumps do not count.
std::vector<Vec3> rim_of(const Surface& surface, std::span<const Index> region) {
  std::vector<std::uint8_t> is_in(surface.points.size(), 0), is_rim(surface.points.size(), 0);
  for (const Index i : region) is_in[i] = 1;
  each_link(
      surface, [&](Index a, Index b) { return is_in[a] != is_in[b]; },
      [&](Index a, Index b) { is_rim[is_in[a] ? a : b] = 1; });
  std::vector<Vec3> rim;
  for (const Index i : region)
    if (is_rim[i]) rim.push_back(surface.points[i]);
  return rim;
}

// Returns the region with its holes filled. A hole is a connected part outside of the region that touches the region
// and has less than a tenth of its points.
std::vector<Index> without_holes(const Surface& surface, std::span<const Index> region) {
  constexpr std::size_t times_less = 10;
  std::vector<std::uint8_t> is_in(surface.points.size(), 0);
  for (const Index i : region) is_in[i] = 1;
  const std::vector<Index> outside = indices_where(is_in.size(), [&](Index i) { return !is_in[i]; });
  DisjointSets sets = connected(surface, outside);
  std::vector<std::size_t> size(outside.size(), 0);
  std::vector<std::uint8_t> touches(outside.size(), 0);
  for (Index i = 0; i < outside.size(); ++i) ++size[sets.find(i)];
  const std::vector<Index> number = places_in(outside, surface.points.size());
  each_link(
      surface, [&](Index a, Index b) { return is_in[a] != is_in[b]; },
      [&](Index a, Index b) { touches[sets.find(number[is_in[a] ? b : a])] = 1; });
  std::vector<Index> all;
  for (Index i = 0; i < is_in.size(); ++i) {
    const Index part = is_in[i] ? no_index : sets.find(number[i]);
    const bool is_hole = part != no_index && touches[part] && size[part] * times_less < region.size();
    if (is_in[i] || (is_hole && !surface.boundary.is_boundary[i])) all.push_back(i);
  }
  return all;
}

// Returns the index in `points` of the point nearest to `place`; no_index if the distance is over 4 rho.
Index nearest_of(const Surface& surface, std::span<const Index> points, const Vec3& place) {
  constexpr double most_rho = 4;
  double least = most_rho * surface.rho;
  Index nearest = no_index;
  for (Index i = 0; i < points.size(); ++i) {
    const double distance = (surface.points[points[i]] - place).norm();
    if (distance < least) least = distance, nearest = i;
  }
  return nearest;
}

StrokePoints points_of_region(const Surface& surface, const Stroke& stroke, const Vec3& seed) {
  const std::vector<float> turning = turning_of(surface);
  const std::vector<Index> calm = indices_where(turning.size(), [&](Index i) {
    return !surface.boundary.is_boundary[i] && turning[i] <= static_cast<float>(stroke.tolerance);
  });
  const Index first = nearest_of(surface, calm, seed);
  if (first == no_index) return {};
  DisjointSets sets = connected(surface, calm);
  std::vector<Index> reached = calm;
  keep_where(reached, [&](std::size_t i) { return sets.find(static_cast<Index>(i)) == sets.find(first); });
  StrokePoints region{without_holes(surface, reached), {}};
  const std::vector<Vec3> rim = rim_of(surface, region.points);
  const KdTree<Vec3> tree(rim);
  region.distances.resize(region.points.size(), 0);
  parallel_for(region.points.size(), [&](std::size_t i) {
    Index near = 0;
    double distance_sq = 0;
    if (tree.nearest(surface.points[region.points[i]], 1, &near, &distance_sq) == 1)
      region.distances[i] = std::max(0., stroke.radius - std::sqrt(distance_sq));
  });
  return kept(region, [&](Index i) { return region.distances[i] < stroke.radius; });
}

}  // namespace

StrokePoints points_of(const Surface& surface, const Stroke& stroke) {
  const Mat3& R = surface.view.R_view_model;
  std::vector<Vec3> corners;
  for (const Vec3& p : stroke.points) corners.push_back(R * (p - surface.centre));
  if (corners.empty() || !(stroke.radius > 0)) return {};
  switch (stroke.area) {
    case StrokeArea::line:
      return points_at_line(surface, corners, stroke.radius);
    case StrokeArea::lasso:
      return points_in_lasso(surface, {corners, R * stroke.direction.normalized()}, stroke.radius);
    case StrokeArea::region:
      return points_of_region(surface, stroke, corners[0]);
  }
  return {};
}

}  // namespace relievo
