// What a layered relief keeps of its model, against gradient-domain compression.
#pragma once

#include <span>
#include <vector>

#include "membrane.h"
#include "quality/fast_metrics.h"
#include "relievo/relief/heights.h"
#include "relievo/scan/surface.h"

namespace relievo {

// Views what it is made of, which must outlive it. Const calls may run concurrently.
class Yardstick {
 public:
  // `system` is that of all points.
  Yardstick(const Surface& surface, const Membrane& membrane, const HeightSystem& system);

  // Whether there are pixels to look at, and anything to compress.
  bool is_of_use() const;

  const QuickJudge& judge() const { return judge_; }
  const Membrane& membrane() const { return membrane_; }

  // What (9) gives layered_shape() at u, not yet held; in single precision.
  std::vector<double> heights(double u, const Hold& hold) const;

  // How much more compression of the same height keeps than such heights, held.
  Kept lacking(std::vector<double> heights, const Hold& hold) const;

 private:
  std::vector<double> solved(std::span<const Vec2> slopes) const;

  const Surface& surface_;
  const Membrane& membrane_;
  const HeightSystem& system_;
  QuickJudge judge_;
  std::vector<float> boundary_weight_;
  std::vector<double> compressed_;
  double compressed_span_;
};

}  // namespace relievo
