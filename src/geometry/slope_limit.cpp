#include "geometry/slope_limit.h"

#include <algorithm>
#include <array>
#include <limits>

#include "core/groups.h"
#include "geometry/plane.h"
#include "relievo/core/parallel.h"

namespace relievo {
namespace {

// Limits of the effort. If a field needs more, it has too many steep triangles for this method, or its fixed
// points allow no solution.
constexpr int most_sweeps = 4000;
constexpr std::size_t most_visits = 10;  // per triangle of the field on average, plus one visit per sweep
// Triangles are made flatter than necessary by this fraction. Without it, neighbours would push each other
// over the limit forever, by ever smaller amounts. A larger fraction pushes more neighbours over the limit.
// So the fraction grows with the number of sweeps.
constexpr double least_spare = 2e-5, most_spare = 1e-3;
// Two thin triangles that share a short edge can undo each other's moves of the two ends of this edge. Only
// moves of the triangles' distant corners help, and least squares hardly moves these corners. So every 64th
// sweep scales the heights of triangles instead, by at most most_spare, which breaks such cycles. Scaling is
// rare, because it moves points further than necessary.
constexpr int sweeps_to_scaling = 64;

// Returns the slope of a triangle as rise over run. Vertical and overturned triangles count as infinitely steep. An
// exception are overturned triangles that are level: their slope is 0, because they are slivers that rounding has
// turned over.
double steepness(const PlaneMesh& field, const Triangle& t, std::span<const double> heights) {
  const Vec2 &a = field.plane[t[0]], &b = field.plane[t[1]], &c = field.plane[t[2]];
  if (!(cross(b - a, c - a) > 0)) {
    const bool is_level = heights[t[0]] == heights[t[1]] && heights[t[1]] == heights[t[2]];
    return is_level ? 0 : std::numeric_limits<double>::infinity();
  }
  return triangle_slope(field, t, heights).norm();
}

// The triangles around each point.
using VertexStars = Groups<Index>;

VertexStars vertex_stars(const PlaneMesh& field) {
  return grouped<Index>(field.plane.size(), [&](auto&& add) {
    for (Index t = 0; t < field.triangles.size(); ++t)
      for (const Index i : field.triangles[t]) add(i, t);
  });
}

class SlopeLimiter {
 public:
  SlopeLimiter(const PlaneMesh& field, double max_slope, Rounding rounding, std::span<double> heights)
      : field_(field),
        max_slope_(max_slope),
        rounding_(rounding),
        heights_(heights),
        exact_(heights.begin(), heights.end()) {}

  bool run() {
    std::vector<Index> steep = all_steep();
    if (steep.empty()) return true;
    const VertexStars stars = vertex_stars(field_);
    std::size_t visits = 0;
    for (int sweep = 0; sweep < most_sweeps && !steep.empty(); ++sweep) {
      visits += steep.size();
      if (visits > most_visits * field_.triangles.size() + most_sweeps) return false;
      const bool is_scaling = sweep % sweeps_to_scaling == sweeps_to_scaling - 1;
      const double wanted = max_slope_ * (1 - std::min(most_spare, least_spare * (1 + sweep / 10)));
      // Triangles are projected one after the other, not concurrently. Each projection uses the moves of
      // earlier ones, which converges faster and makes the result independent of the number of threads.
      for (const Index t : steep)
        if (is_steep(t)) project(field_.triangles[t], wanted, is_scaling);
      steep = steep_around(steep, stars);
    }
    return steep.empty();
  }

 private:
  bool is_steep(Index t) const { return steepness(field_, field_.triangles[t], heights_) > max_slope_; }

  std::vector<Index> all_steep() const {
    return parallel_reduce(
        field_.triangles.size(), std::vector<Index>{},
        [&](std::size_t begin, std::size_t end) {
          std::vector<Index> found;
          for (std::size_t t = begin; t < end; ++t)
            if (is_steep(static_cast<Index>(t))) found.push_back(static_cast<Index>(t));
          return found;
        },
        [](std::vector<Index> all, const std::vector<Index>& part) {
          all.insert(all.end(), part.begin(), part.end());
          return all;
        });
  }

  // Returns the steep triangles that share a corner with a triangle of `worked_on`.
  std::vector<Index> steep_around(const std::vector<Index>& worked_on, const VertexStars& stars) const {
    std::vector<Index> around;
    for (const Index t : worked_on)
      for (const Index i : field_.triangles[t]) around.insert(around.end(), stars[i].begin(), stars[i].end());
    std::ranges::sort(around);
    around.erase(std::ranges::unique(around).begin(), around.end());
    std::erase_if(around, [&](Index t) { return !is_steep(t); });
    return around;
  }

  // Reduces the slope of a triangle to `wanted`: moves its free corners so that the sum of squares of their moves is
  // least. If `is_scaling`, scales the heights instead, unless two corners are fixed.
  void project(const Triangle& t, double wanted, bool is_scaling) {
    const Vec2 slope = triangle_slope(field_, t, heights_);
    const double steepness = slope.norm();
    // A triangle without area has no finite slope, whatever its heights are.
    if (!slope.allFinite() || steepness < wanted) return;
    if (is_scaling && std::ranges::count_if(t, [&](Index i) { return field_.is_fixed[i]; }) < 2)
      return scale(t, std::max(wanted / steepness, 1 - most_spare));
    const std::array corners{field_.plane[t[0]], field_.plane[t[1]], field_.plane[t[2]]};
    const std::array<Vec2, 3> gradients =
        hat_gradients(corners, cross(corners[1] - corners[0], corners[2] - corners[0]));
    std::array<double, 3> pull{};
    double sum_sq = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      if (field_.is_fixed[t[i]]) continue;
      pull[i] = gradients[i].dot(slope) / steepness;
      sum_sq += pull[i] * pull[i];
    }
    if (!(sum_sq > 0)) return;
    for (std::size_t i = 0; i < 3; ++i)
      if (pull[i] != 0) move(t[i], (wanted - steepness) * pull[i] / sum_sq);
  }

  // Scales the heights of a triangle about the height of its fixed corner or, if none is fixed, about their
  // mean.
  void scale(const Triangle& t, double share) {
    double centre = (heights_[t[0]] + heights_[t[1]] + heights_[t[2]]) / 3;
    for (const Index i : t)
      if (field_.is_fixed[i]) centre = heights_[i];
    for (const Index i : t)
      if (!field_.is_fixed[i]) move(i, (share - 1) * (heights_[i] - centre));
  }

  void move(Index i, double by) {
    exact_[i] += by;
    heights_[i] =
        rounding_ == Rounding::none ? exact_[i] : static_cast<double>(static_cast<float>(exact_[i]));
  }

  PlaneMesh field_;
  double max_slope_;
  Rounding rounding_;
  std::span<double> heights_;
  // The heights before rounding. Rounded heights would lose moves below half a rounding step.
  std::vector<double> exact_;
};

}  // namespace

Vec2 triangle_slope(const PlaneMesh& field, const Triangle& t, std::span<const double> heights) {
  const Vec2 p = field.plane[t[0]] - field.plane[t[2]], q = field.plane[t[1]] - field.plane[t[2]];
  const double up_p = heights[t[0]] - heights[t[2]], up_q = heights[t[1]] - heights[t[2]];
  return Vec2(up_p * q.y() - up_q * p.y(), up_q * p.x() - up_p * q.x()) / cross(p, q);
}

double steepest_of(const PlaneMesh& field, std::span<const double> heights) {
  return parallel_reduce(
      field.triangles.size(), 0.0,
      [&](std::size_t begin, std::size_t end) {
        double steepest = 0;
        for (std::size_t t = begin; t < end; ++t)
          steepest = std::max(steepest, steepness(field, field.triangles[t], heights));
        return steepest;
      },
      [](double a, double b) { return std::max(a, b); });
}

bool limit_slopes(const PlaneMesh& field, double max_slope, Rounding rounding, std::span<double> heights) {
  return SlopeLimiter(field, max_slope, rounding, heights).run();
}

}  // namespace relievo
