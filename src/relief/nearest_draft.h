// Changes the slopes of a relief as little as possible, so that they stay within a limit.
#pragma once

#include <span>
#include <vector>

#include "relievo/geometry/triangulation.h"
#include "relievo/relief/heights.h"
#include "relievo/scan/boundary.h"
#include "relievo/scan/surface.h"

namespace relievo {

// The triangles inside a relief, except those with all corners on the boundary. Slopes are (dz/dx, dz/dy).
class TriangleSlopes {
 public:
  TriangleSlopes(std::span<const Vec2> points, const Triangulation& triangulation, const Boundary& boundary);

  std::size_t size() const { return triangles_.size(); }

  // Returns the slope of triangle t for heights, one per point.
  template <typename Real>
  Eigen::Vector2<Real> slope(std::size_t t, std::span<const Real> heights) const {
    const auto& [corners, first, second] = triangles_[t];
    const Real last = heights[corners[2]];
    return (heights[corners[0]] - last) * first.template cast<Real>() +
           (heights[corners[1]] - last) * second.template cast<Real>();
  }

  // For each point i, writes a sum over the triangles around it. The term of a triangle is its area times
  // (field . gradient of i's hat function). Boundary points get 0. If the field consists of slopes, the sums
  // are the right-hand side of equation (9).
  void divergence(std::span<const Vec2f> field, std::span<float> sums) const;

 private:
  struct Corners {
    Triangle corners;
    Vec2f first = Vec2f::Zero(),
          second = Vec2f::Zero();  // gradients of the hat functions of the first two corners
  };
  struct Share {
    Index triangle = 0;
    Vec2f weight = Vec2f::Zero();  // area times gradient of the hat function
  };

  std::vector<Corners> triangles_;
  std::vector<Index> begin_;  // point i has the shares begin_[i] up to begin_[i + 1]
  std::vector<Share> shares_;
};

// Minimises the weighted sum over triangles of |slope - target slope|^2 under |slope + slope of the base| <=
// limit. The method is ADMM (alternating direction method of multipliers; Boyd, Parikh, Chu, Peleato and
// Eckstein, 2011). Each iteration projects the slope of each triangle onto the limit. The projection changes
// the slope; this change is added to a dual variable. Then heights are fitted to the target slopes and the
// projected slopes, by a system that is factored once. Iterations end when hardly any triangle exceeds the
// limit, or after 200 of them. Each call starts from the result of the last one. Not for concurrent use.
class NearestDraft {
 public:
  // `system` is the system of `surface`; both must outlive this object. `base` has a height per point, or is
  // empty.
  NearestDraft(const Surface& surface, const HeightSystem& system, std::span<const double> base,
               double max_slope);

  // Changes the heights to those of the nearest relief within the limit. A few triangles stay steeper than the limit,
  // usually by at most 0.4 %. Ends early when is_cancelled() returns true; the heights are then meaningless.
  template <typename F>
  void apply(std::span<double> heights, F&& is_cancelled) {
    begin(heights);
    for (int round = 0; round < most_rounds && !is_cancelled(); ++round) {
      step();
      if (round % check_every == check_every - 1 && is_good()) break;
    }
    end(heights);
  }

 private:
  static constexpr int most_rounds = 200, check_every = 10;

  void begin(std::span<const double> heights);
  void step();
  bool is_good() const;
  void end(std::span<double> heights) const;

  Vec2f projected(const Vec2f& slope, std::size_t triangle, float steepest) const;

  const HeightSystem& system_;
  TriangleSlopes triangles_;
  float max_slope_;
  HeightSystem::Workspace workspace_;
  // Slopes per triangle, in this order: those of the base (or empty); the target; the shortened target; the
  // projected slopes; the dual variable; and the slopes that the change of the heights is fitted to.
  std::vector<Vec2f> base_, given_, counted_, projected_, dual_, field_;
  std::vector<float> first_, heights_, change_;  // per point: target, current, and change
  bool is_started_ = false;
};

}  // namespace relievo
