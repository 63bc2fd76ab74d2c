// How tightly layered reliefs of a model are held: as tightly as they may be without losing more of its
// coarse detail and of the order of its depths than gradient-domain compression does.
#pragma once

#include <array>

#include "membrane.h"
#include "relievo/heights.h"
#include "relievo/progress.h"
#include "relievo/surface.h"
#include "relievo/weights.h"

namespace relievo {

class Grip {
 public:
  // Finds the holds by bisection, at five u, measured by QuickJudge: for layered_shape(), and used for
  // others. `system` is that of all points. Where no hold keeps the order, it keeps the detail; where none
  // keeps that, it is loose; where points are too few to measure by, usual. A little tighter, where heights
  // would else fall as u grows. Errors: kind cancelled. 0.2 s for 180k points.
  static Result<Grip> find(const Surface& surface, const Membrane& membrane, const HeightSystem& system,
                           const Progress* progress = nullptr);

  // The hold at u in [0, infinity]. Its share comes to 1; the height that it holds (9) to grows with u.
  Hold at(double u) const;

 private:
  // Of u; between them in proportion to log u.
  static constexpr std::array<double, 5> knots{.25, .5, 1, 2, 4};

  std::array<Hold, knots.size()> holds_;  // share as for u = 0
};

}  // namespace relievo
