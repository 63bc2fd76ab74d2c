// The relief under a slope limit that is nearest to another in its slopes.
#pragma once

#include <span>
#include <vector>

#include "relief/triangle_slopes.h"
#include "relievo/relief/heights.h"
#include "relievo/scan/surface.h"

namespace relievo {

// Solves, over triangles, the least squares of (slope - slope given) under |slope + slope of the base| <=
// limit by splitting (alternating direction method of multipliers; Boyd, Parikh, Chu, Peleato and Eckstein,
// 2011): slopes are cut triangle by triangle, heights fit them by a system that is factored once, and
// what a cut took is carried over until both agree. Starts from where the last call ended. Not for concurrent
// use.
class NearestDraft {
 public:
  // The system is that of the surface, without weights; both must outlive this. `base`: heights per point, or
  // empty.
  NearestDraft(const Surface& surface, const HeightSystem& system, std::span<const double> base,
               double max_slope);

  // Makes the heights those of the nearest relief. A few triangles stay steeper, by a per cent at most as a
  // rule. `is_cancelled()` is asked now and then; then the heights are of no use.
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

  Vec2f cut(const Vec2f& slope, std::size_t triangle, float steepest) const;

  const HeightSystem& system_;
  TriangleSlopes triangles_;
  float max_slope_;
  HeightSystem::Workspace workspace_;
  // Per triangle. Slopes: of the base, or empty; given; given, but no steeper than counts; cut; and what was
  // cut off so far.
  std::vector<Vec2f> base_, given_, counted_, cut_, debt_, field_;
  std::vector<float> first_, heights_, change_;  // per point: given, now, and what lies between the two
  bool is_started_ = false;
};

}  // namespace relievo
