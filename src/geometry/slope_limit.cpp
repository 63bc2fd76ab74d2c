#include "steep_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "relievo/core/parallel.h"

namespace relievo {
namespace {

constexpr int most_sweeps = 4000;
constexpr std::size_t most_visits = 10;  // per triangle of the field, besides one in every sweep
// A triangle is made a little flatter than it must be, more so the longer it takes: else neighbours would
// push each other over the limit by ever less, but for ever. Far flatter would push more of them over it.
constexpr double least_spare = 2e-5, most_spare = 1e-3;
// Of two needles on one short edge each may take back what the other does to its ends, and both wait for
// their far corners, which least squares hardly move. So now and then a triangle is scaled instead, by a
// little: that leaves less for the two to settle, but moves points farther than it must.
constexpr int sweeps_to_scaling = 64;

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// Gradients of the corners' hat functions.
std::array<Vec2, 3> hat_gradients(const SteepField& field, const Triangle& t) {
  const Vec2 &a = field.plane[t[0]], &b = field.plane[t[1]], &c = field.plane[t[2]];
  const double twice_area = cross(b - a, c - a);
  const auto gradient = [&](const Vec2& opposite) {
    return Vec2(-opposite.y() / twice_area, opposite.x() / twice_area);
  };
  return {gradient(c - b), gradient(a - c), gradient(b - a)};
}

// Upright and overhanging triangles are steeper than any, but for level ones: slivers that rounding turned
// over.
double steepness(const SteepField& field, const Triangle& t, std::span<const double> heights) {
  const Vec2 &a = field.plane[t[0]], &b = field.plane[t[1]], &c = field.plane[t[2]];
  if (!(cross(b - a, c - a) > 0)) {
    const bool is_level = heights[t[0]] == heights[t[1]] && heights[t[1]] == heights[t[2]];
    return is_level ? 0 : std::numeric_limits<double>::infinity();
  }
  return triangle_slope(field, t, heights).norm();
}

// Triangles around each point.
struct Fans {
  std::vector<Index> begin, triangles;

  explicit Fans(const SteepField& field) : begin(field.plane.size() + 1, 0) {
    for (const Triangle& t : field.triangles)
      for (const Index i : t) ++begin[i + 1];
    for (std::size_t i = 1; i < begin.size(); ++i) begin[i] += begin[i - 1];
    triangles.resize(begin.back());
    std::vector<Index> next(begin.begin(), begin.end() - 1);
    for (std::size_t t = 0; t < field.triangles.size(); ++t)
      for (const Index i : field.triangles[t]) triangles[next[i]++] = static_cast<Index>(t);
  }
};

class Flattener {
 public:
  Flattener(const SteepField& field, double max_slope, Rounding rounding, std::span<double> heights)
      : field_(field),
        max_slope_(max_slope),
        rounding_(rounding),
        heights_(heights),
        exact_(heights.begin(), heights.end()) {}

  bool run() {
    std::vector<Index> steep = all_steep();
    if (steep.empty()) return true;
    const Fans fans(field_);
    std::size_t visits = 0;
    for (int sweep = 0; sweep < most_sweeps && !steep.empty(); ++sweep) {
      visits += steep.size();
      if (visits > most_visits * field_.triangles.size() + most_sweeps) return false;
      const bool is_scaling = sweep % sweeps_to_scaling == sweeps_to_scaling - 1;
      const double wanted = max_slope_ * (1 - std::min(most_spare, least_spare * (1 + sweep / 10)));
      for (const Index t : steep)
        if (is_steep(t)) flatten_one(field_.triangles[t], wanted, is_scaling);
      steep = steep_around(steep, fans);
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

  // Of the triangles that share a corner with those just worked on.
  std::vector<Index> steep_around(const std::vector<Index>& worked_on, const Fans& fans) const {
    std::vector<Index> around;
    for (const Index t : worked_on)
      for (const Index i : field_.triangles[t])
        around.insert(around.end(), fans.triangles.begin() + fans.begin[i],
                      fans.triangles.begin() + fans.begin[i + 1]);
    std::ranges::sort(around);
    around.erase(std::ranges::unique(around).begin(), around.end());
    std::erase_if(around, [&](Index t) { return !is_steep(t); });
    return around;
  }

  void flatten_one(const Triangle& t, double wanted, bool is_scaling) {
    const Vec2 slope = triangle_slope(field_, t, heights_);
    const double steepness = slope.norm();
    if (!slope.allFinite() || steepness < wanted) return;  // overturned, which no slope mends
    if (is_scaling && std::ranges::count_if(t, [&](Index i) { return field_.is_fixed[i]; }) < 2)
      return scale(t, std::max(wanted / steepness, 1 - most_spare));
    const std::array<Vec2, 3> gradients = hat_gradients(field_, t);
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

  // About the corner that stays, if one does.
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

  SteepField field_;
  double max_slope_;
  Rounding rounding_;
  std::span<double> heights_;
  std::vector<double> exact_;  // before rounding, which would for ever take all of a move below half a step
};

}  // namespace

Vec2 triangle_slope(const SteepField& field, const Triangle& t, std::span<const double> heights) {
  const Vec2 p = field.plane[t[0]] - field.plane[t[2]], q = field.plane[t[1]] - field.plane[t[2]];
  const double up_p = heights[t[0]] - heights[t[2]], up_q = heights[t[1]] - heights[t[2]];
  return Vec2(up_p * q.y() - up_q * p.y(), up_q * p.x() - up_p * q.x()) / cross(p, q);
}

double steepest_of(const SteepField& field, std::span<const double> heights) {
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

bool flatten(const SteepField& field, double max_slope, Rounding rounding, std::span<double> heights) {
  return Flattener(field, max_slope, rounding, heights).run();
}

}  // namespace relievo
