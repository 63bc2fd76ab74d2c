#include "geometry/raised_shape.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

#include "geometry/plane.h"

namespace relievo {
namespace {

constexpr double fan_step = std::numbers::pi / 18;  // largest angle between rays from a reflex corner
constexpr double least_opening = .02;               // no wall rises from corners below 11 degrees
constexpr int halvings = 30;
// The least distance between points, as a share of a wall's width. A new point closer to another one is merged with it.
constexpr double least_share = .05;
constexpr double rounding_mm = 2e-6;  // union_boundary() rounds corners by up to this

// A line from the outline inwards. The point foot + t * direction is at distance t from the outline, as long as no
// other part of the outline is nearer.
struct Ray {
  Vec2 foot, direction;
  bool is_on_side = false;  // true if the foot is not a corner
  bool is_edge = false;     // true if two walls meet along the ray
};

Vec2 left_of(const Vec2& step) {
  return Vec2(-step.y(), step.x()).normalized();
}

// Adds the rays that start at a corner. `before` and `after` are the inner normals of the two sides at the
// corner.
void add_corner(const Vec2& corner, const Vec2& before, const Vec2& after, std::vector<Ray>& rays) {
  const double opening = 1 + before.dot(after);
  const bool is_reflex = cross(before, after) < 0;
  const double turn = std::acos(std::clamp(before.dot(after), -1.0, 1.0));
  if (!is_reflex && opening < least_opening) return rays.push_back({corner, Vec2::Zero()});
  // The direction is longer than 1, so that the ray's point at t is at distance t from the lines of both
  // sides.
  if (!is_reflex || turn < fan_step)
    return rays.push_back({corner, (before + after) / opening, false, turn > fan_step});
  const int steps = static_cast<int>(std::ceil(turn / fan_step));
  for (int k = 0; k <= steps; ++k) {
    const Eigen::Rotation2D<double> rotation(-turn * k / steps);
    const double length = k == 0 || k == steps ? 1 : 1 / std::cos(turn / steps / 2);
    rays.push_back({corner, length * (rotation * before)});
  }
}

using CornerKey = std::pair<double, double>;
CornerKey corner_of(const Vec2& p) {
  return {p.x(), p.y()};
}

// Returns the sides as closed loops. If several sides begin at a corner, the loop continues with the first
// unused one.
std::vector<std::vector<Index>> loops_of(const std::vector<Segment>& sides) {
  std::map<CornerKey, std::vector<Index>> starting;
  for (Index i = 0; i < sides.size(); ++i) starting[corner_of(sides[i].from)].push_back(i);
  std::vector<std::uint8_t> is_used(sides.size(), 0);
  std::vector<std::vector<Index>> loops;
  for (Index first = 0; first < sides.size(); ++first) {
    if (is_used[first]) continue;
    std::vector<Index>& loop = loops.emplace_back();
    for (Index i = first; i != no_index;) {
      is_used[i] = 1;
      loop.push_back(i);
      const std::vector<Index>& next = starting[corner_of(sides[i].to)];
      const auto free = std::ranges::find_if(next, [&](Index n) { return !is_used[n]; });
      i = free == next.end() ? no_index : *free;
    }
  }
  return loops;
}

std::vector<Ray> rays_along(const std::vector<Segment>& sides, const std::vector<Index>& loop,
                            double spacing) {
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Segment &side = sides[loop[i]], &before = sides[loop[(i + loop.size() - 1) % loop.size()]];
    const Vec2 step = side.to - side.from, normal = left_of(step);
    if (before.to == side.from) add_corner(side.from, left_of(before.to - before.from), normal, rays);
    const int parts = std::max(1, static_cast<int>(std::ceil(step.norm() / spacing)));
    for (int k = 1; k < parts; ++k)
      rays.push_back({side.from + static_cast<double>(k) / parts * step, normal, true});
  }
  return rays;
}

// Numbered points that keep a least distance from each other.
class NumberedPoints {
 public:
  explicit NumberedPoints(double distance) : distance_(distance) {}

  // Adds a point with the given number, unless it is too near to another point. Returns the number of the added point
  // or, if it is too near, of that other point.
  Index add(const Vec2& place, Index number) {
    const std::int64_t x = cell_of(place.x()), y = cell_of(place.y());
    const Numbered* nearest = nullptr;
    for (std::int64_t j = y - 1; j <= y + 1; ++j)
      for (std::int64_t i = x - 1; i <= x + 1; ++i)
        if (const auto found = cells_.find({i, j}); found != cells_.end())
          for (const Numbered& other : found->second)
            if (!nearest || (other.place - place).norm() < (nearest->place - place).norm()) nearest = &other;
    if (nearest && (nearest->place - place).norm() < distance_) return nearest->number;
    cells_[{x, y}].push_back({place, number});
    return number;
  }

 private:
  struct Numbered {
    Vec2 place;
    Index number;
  };

  std::int64_t cell_of(double v) const { return static_cast<std::int64_t>(std::floor(v / distance_)); }

  double distance_;
  std::map<std::pair<std::int64_t, std::int64_t>, std::vector<Numbered>> cells_;
};

class ShapePointMaker {
 public:
  explicit ShapePointMaker(const RaisedShape& shape)
      : shape_(shape),
        depth_(shape.levels.back().distance_mm),
        grid_(union_boundary(shape.outlines), std::max(depth_, shape.spacing_mm)),
        least_(std::max(least_share * std::min(shape.spacing_mm, shape.levels[1].distance_mm), rounding_mm)),
        near_(least_) {}

  ShapePoints make() {
    const std::vector<Segment> sides(grid_.segments().begin(), grid_.segments().end());
    for (const std::vector<Index>& loop : loops_of(sides))
      loops_.push_back(rays_along(sides, loop, shape_.spacing_mm));
    for (const std::vector<Ray>& rays : loops_) feet_of_.push_back(add_feet(rays));
    made_.feet = made_.points.size();
    for (const std::vector<Ray>& rays : loops_) find_ridges(rays);
    tops_.resize(loops_.size());
    for (std::size_t loop = 0; loop < loops_.size(); ++loop) add_levels(loop);
    for (const bool are_edges : {true, false})
      for (std::size_t loop = 0; loop < loops_.size(); ++loop) add_spokes(loop, are_edges);
    measure_strokes();
    return std::move(made_);
  }

 private:
  // Adds the feet of the rays, and the outline's edges between them. Returns the index of each ray's foot.
  std::vector<Index> add_feet(const std::vector<Ray>& rays) {
    std::vector<Index> numbers, of_rays;
    for (const Ray& ray : rays) {
      const auto [place, is_new] =
          feet_.try_emplace(corner_of(ray.foot), static_cast<Index>(made_.points.size()));
      if (is_new) made_.points.emplace_back(ray.foot.x(), ray.foot.y(), 0);
      if (is_new) near_.add(ray.foot, place->second);
      if (numbers.empty() || numbers.back() != place->second) numbers.push_back(place->second);
      of_rays.push_back(place->second);
    }
    connect(numbers);
    return of_rays;
  }

  void connect(const std::vector<Index>& loop) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Index a = loop[i], b = loop[(i + 1) % loop.size()];
      if (a != no_index && b != no_index && a != b) made_.edges.push_back({a, b});
    }
  }

  // Returns whether no part of the outline is nearer than t to the ray's point foot + t * direction.
  bool is_clear(const Ray& ray, double t) const {
    return grid_.nearest(ray.foot + t * ray.direction, t * (1 - 1e-7) - rounding_mm).segment == no_index;
  }

  // Adds a point unless another one is too near. Returns its index, or that of the other point; no_index if a place
  // reserved by keep_clear() is too near.
  Index add(const Vec2& place, double height) {
    const auto next = static_cast<Index>(made_.points.size());
    const Index number = near_.add(place, next);
    if (number != next) return number;
    made_.points.emplace_back(place.x(), place.y(), height);
    made_.most_mm = std::max(made_.most_mm, std::abs(height));
    return next;
  }

  // Adds the points of all levels, beginning with the level next to the outline. A ray has a point on a level
  // only if no part of the outline is nearer to this point than the level's distance.
  void add_levels(std::size_t loop) {
    const std::vector<Ray>& rays = loops_[loop];
    tops_[loop].resize(rays.size());
    for (std::size_t level = 1; level < shape_.levels.size(); ++level) {
      const auto [distance, height] = shape_.levels[level];
      std::vector<Index> numbers;
      for (std::size_t i = 0; i < rays.size(); ++i) {
        const Ray& ray = rays[i];
        const bool is_there = ray.direction != Vec2::Zero() && is_clear(ray, distance);
        numbers.push_back(is_there ? add(ray.foot + distance * ray.direction, height) : no_index);
        if (numbers.back() != no_index) tops_[loop][i].push_back(numbers.back());
      }
      connect(numbers);
    }
  }

  // Connects each foot to the points above it, so that the wall between two rays is plane. Rays along which
  // two walls meet come first (`are_edges`), so that no other point gets too close to the edges along these
  // rays.
  void add_spokes(std::size_t loop, bool are_edges) {
    for (std::size_t i = 0; i < loops_[loop].size(); ++i) {
      const Ray& ray = loops_[loop][i];
      if (ray.is_edge != are_edges || ray.direction == Vec2::Zero()) continue;
      std::vector<Index>& tops = tops_[loop][i];
      const Index end = add_ridge(ray, ridges_[loop][i]);
      if (end != no_index) tops.push_back(end);
      Index last = feet_of_[loop][i];
      for (const Index top : tops) {
        if (last != top) made_.edges.push_back({last, top});
        if (last != top && are_edges) keep_clear(last, top);
        last = top;
      }
    }
  }

  // Reserves places along an edge, so that no ridge point is added close to it later. Parts of the edge without
  // ridges near them are skipped.
  void keep_clear(Index a, Index b) {
    const Vec2 from = made_.points[a].head<2>(), step = made_.points[b].head<2>() - from;
    const int parts = std::min(1000, static_cast<int>(std::ceil(step.norm() / (least_ / 2))));
    const auto place = [&](int k) { return Vec2(from + static_cast<double>(k) / parts * step); };
    constexpr int block = 8;
    for (int first = 1; first < parts; first += block) {
      const int end = std::min(first + block, parts);
      if (!near_ridges_.contains(cell_of(place(first))) && !near_ridges_.contains(cell_of(place(end))))
        continue;
      for (int k = first; k < end; ++k) near_.add(place(k), no_index);
    }
  }

  double height_at(double distance) const {
    const std::vector<WallLevel>& levels = shape_.levels;
    std::size_t k = 1;
    while (k + 1 < levels.size() && levels[k].distance_mm < distance) ++k;
    const WallLevel &low = levels[k - 1], &high = levels[k];
    const double share = (distance - low.distance_mm) / (high.distance_mm - low.distance_mm);
    return low.height_mm + std::clamp(share, 0.0, 1.0) * (high.height_mm - low.height_mm);
  }

  using Cell = std::pair<std::int64_t, std::int64_t>;

  // Returns the cell of a place. keep_clear() tests an edge one part at a time; a cell is wider than the
  // longest part plus the least distance between points.
  Cell cell_of(const Vec2& place) const {
    const auto at = [&](double v) { return static_cast<std::int64_t>(std::floor(v / (8 * least_))); };
    return {at(place.x()), at(place.y())};
  }

  // Returns the distance along the ray at which it meets the wall of another side; nothing if no such wall comes
  // before the last level.
  std::optional<double> ridge_of(const Ray& ray) const {
    if (ray.direction == Vec2::Zero() || is_clear(ray, depth_)) return std::nullopt;
    const double low = clear_limits(ray, depth_).first;
    return low > 1e-3 * depth_ ? std::optional(low) : std::nullopt;
  }

  // Returns two distances along the ray that are close to each other: is_clear() is true at the first one and
  // false at the second one. is_clear() must be false at `high`.
  std::pair<double, double> clear_limits(const Ray& ray, double high) const {
    double low = 0;
    for (int k = 0; k < halvings; ++k) {
      const double middle = (low + high) / 2;
      (is_clear(ray, middle) ? low : high) = middle;
    }
    return {low, high};
  }

  void find_ridges(const std::vector<Ray>& rays) {
    std::vector<std::optional<double>>& ridges = ridges_.emplace_back();
    for (const Ray& ray : rays) {
      ridges.push_back(ridge_of(ray));
      if (!ridges.back()) continue;
      const auto [x, y] = cell_of(ray.foot + *ridges.back() * ray.direction);
      for (std::int64_t j = y - 1; j <= y + 1; ++j)
        for (std::int64_t i = x - 1; i <= x + 1; ++i) near_ridges_.insert({i, j});
    }
  }

  // Adds the point where the ray meets the wall of another side, and returns its index. Returns no_index if
  // the ray meets no wall.
  Index add_ridge(const Ray& ray, const std::optional<double>& distance) {
    return distance ? add(ray.foot + *distance * ray.direction, height_at(*distance)) : no_index;
  }

  // Finds the smallest distance between two sides with nearly opposite directions. Distances above 2 mm are ignored.
  void measure_strokes() {
    made_.thinnest_mm = std::numeric_limits<double>::infinity();
    constexpr double opposite = -.95, most_mm = 2;
    for (const std::vector<Ray>& rays : loops_)
      for (const Ray& ray : rays) {
        if (!ray.is_on_side) continue;
        if (is_clear(ray, most_mm / 2)) continue;
        const double high = clear_limits(ray, most_mm / 2).second;
        const NearestSegment facing = grid_.nearest(ray.foot + high * ray.direction, high * (1 - 1e-9));
        if (facing.segment == no_index) continue;
        const Segment& side = grid_.segments()[facing.segment];
        if (left_of(side.to - side.from).dot(ray.direction) < opposite)
          made_.thinnest_mm = std::min(made_.thinnest_mm, 2 * high);
      }
  }

  const RaisedShape& shape_;
  double depth_;
  SegmentGrid grid_;
  double least_;  // least distance between points of levels and ridges
  NumberedPoints near_;
  std::vector<std::vector<Ray>> loops_;
  std::vector<std::vector<std::optional<double>>> ridges_;  // per loop and ray: distance, see ridge_of()
  std::set<Cell> near_ridges_;                              // the cells at and around ridges
  std::map<CornerKey, Index> feet_;
  std::vector<std::vector<Index>> feet_of_;            // per loop and ray: the index of its foot
  std::vector<std::vector<std::vector<Index>>> tops_;  // per loop and ray: the points above its foot
  ShapePoints made_;
};

}  // namespace

std::vector<WallLevel> leaning_wall(double height_mm, double slope) {
  return {{0, 0}, {std::abs(height_mm) / slope, height_mm}};
}

std::vector<WallLevel> round_wall(double height_mm, double radius_mm, double slope) {
  const double most = radius_mm * std::tan(std::atan(slope) / 2);
  const double height = std::min(std::abs(height_mm), most), sign = height_mm < 0 ? -1 : 1;
  const double ball = (radius_mm * radius_mm + height * height) / (2 * height);
  constexpr int steps = 6;
  std::vector<WallLevel> levels;
  for (int k = 0; k <= steps; ++k) {
    const double across = radius_mm * std::cos(k * std::numbers::pi / 2 / steps);
    const double rise = std::sqrt(ball * ball - across * across) - (ball - height);
    levels.push_back({radius_mm - across, sign * std::max(0.0, rise)});
  }
  levels.front() = {0, 0};
  levels.back() = {radius_mm, sign * height};
  return levels;
}

ShapePoints points_of(const RaisedShape& shape) {
  return ShapePointMaker(shape).make();
}

}  // namespace relievo
