#include "relievo/relief/control_points.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/lists.h"

namespace relievo {
namespace {

// The points chosen so far, grouped into square cells that are at least one radius wide.
class ChosenPoints {
 public:
  ChosenPoints(std::span<const Vec2> points, double radius) : points_(points) {
    Vec2 high = points[0];
    low_ = points[0];
    for (const Vec2& p : points) low_ = low_.cwiseMin(p), high = high.cwiseMax(p);
    constexpr double most_cells = 2048;  // per side of the grid of cells
    side_ = std::max(radius, (high - low_).maxCoeff() / most_cells);
    columns_ = cell((high - low_).x()) + 1;
    rows_ = cell((high - low_).y()) + 1;
    first_.assign(columns_ * rows_, no_index);
    next_.assign(points.size(), no_index);
  }

  void add(Index i) {
    Index& first = first_[row(i) * columns_ + column(i)];
    next_[i] = first;
    first = i;
  }

  // Returns whether any chosen point is nearer to point i than the radius. The radius must not exceed that
  // of the constructor.
  bool has_within(Index i, double radius) const {
    const std::size_t c = column(i), r = row(i);
    for (std::size_t y = r - (r > 0); y <= std::min(r + 1, rows_ - 1); ++y)
      for (std::size_t x = c - (c > 0); x <= std::min(c + 1, columns_ - 1); ++x)
        for (Index j = first_[y * columns_ + x]; j != no_index; j = next_[j])
          if ((points_[i] - points_[j]).squaredNorm() < radius * radius) return true;
    return false;
  }

 private:
  std::size_t cell(double offset) const { return static_cast<std::size_t>(offset / side_); }
  std::size_t column(Index i) const { return cell(points_[i].x() - low_.x()); }
  std::size_t row(Index i) const { return cell(points_[i].y() - low_.y()); }

  std::span<const Vec2> points_;
  Vec2 low_;
  double side_ = 0;
  std::size_t columns_ = 0, rows_ = 0;
  std::vector<Index> first_, next_;  // lists of the points in each cell
};

// Returns the points ordered by distance from the boundary.
std::vector<Index> inward_order(std::span<const Vec2> points, std::span<const float> boundary_distance) {
  std::vector<Index> order = all_indices(points.size());
  const auto key = [&](Index i) { return std::tuple(boundary_distance[i], points[i].x(), points[i].y(), i); };
  std::sort(order.begin(), order.end(), [&](Index a, Index b) { return key(a) < key(b); });
  return order;
}

struct Growth {
  std::span<const Vec2> points;
  std::span<const float> boundary_distance;
  std::vector<Index> order;
  double at_boundary;

  ControlPoints grow(double radius) const {
    ChosenPoints chosen(points, radius);
    ControlPoints result{{}, 0, radius};
    for (const Index i : order) {
      const auto distance = static_cast<double>(boundary_distance[i]);
      if (chosen.has_within(i, std::min(at_boundary * radius + distance / 2, radius))) continue;
      chosen.add(i);
      result.points.push_back(i);
      result.boundary_points += distance == 0;
    }
    return result;
  }
};

// Returns the area of the points' box, for a first guess of the radius.
double box_area(std::span<const Vec2> points) {
  Vec2 low = points[0], high = points[0];
  for (const Vec2& p : points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  const Vec2 size = high - low;
  return std::max(size.x() * size.y(), 1e-6 * size.squaredNorm());
}

}  // namespace

ControlPoints grow_control_points(std::span<const Vec2> points, std::span<const float> boundary_distance,
                                  const ControlPointOptions& options) {
  Growth growth{points, boundary_distance, inward_order(points, boundary_distance), options.at_boundary};
  ControlPoints best{growth.order, 0, 0};
  best.boundary_points =
      static_cast<std::size_t>(std::count(boundary_distance.begin(), boundary_distance.end(), 0.F));
  const auto wanted = static_cast<double>(options.count);
  if (points.size() <= options.count || box_area(points) == 0) return best;

  // The number of chosen points is nearly proportional to 1 / radius^2, so after two or three guesses it is
  // within 3 % of the wanted number.
  double radius = std::sqrt(box_area(points) / wanted);
  for (int round = 0; round < 6; ++round) {
    best = growth.grow(radius);
    const double excess = static_cast<double>(best.points.size()) / wanted;
    if (std::abs(excess - 1) < .03) break;
    radius *= std::sqrt(excess);
  }
  return best;
}

}  // namespace relievo
