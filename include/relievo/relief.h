// The relief of a surface: prepared once, shaped many times. Stages 8, 9, 11, 12 and 14.
#pragma once

#include <vector>

#include "relievo/heights.h"
#include "relievo/surface.h"
#include "relievo/weights.h"

namespace relievo {

struct Shape {
  Compression compression;    // height and saturation
  double gamma = 0;           // detail coefficient, [0, 1]
  double max_slope = 4;       // steepest slope asked of the surface, > 0; 4 is 76 degrees
  double boundary_width = 2;  // of (7), in rho, > 0: more softens the rim
};

struct Relief {
  std::vector<double> heights;  // per point of the surface, above the base, in its units
  double height = 0;            // h: highest minus lowest, base and detail included
  Shape shape;                  // what it was made with
};

// A surface with its factored system. Const calls may run concurrently.
class ReliefModel {
 public:
  // Takes the surface and factors its system. Errors: see HeightSystem::build(); kind cancelled.
  static Result<ReliefModel> prepare(Surface surface, Progress* progress = nullptr);

  const Surface& surface() const { return surface_; }
  const HeightSystem& system() const { return system_; }

  // Returns the relief of that shape.
  Relief make(const Shape& shape) const;

  // Returns the relief whose height is `height`, detail included, by changing the
  // compression's u at the beta, gamma and slope asked for (the intent of Algorithm 1, section 3.6). Errors:
  // kind geometry if no u gives that height, telling the largest that is reached, in units of `unit_mm`
  // millimetres; kind cancelled.
  Result<Relief> make_at_height(double height, Shape shape, double unit_mm,
                                Progress* progress = nullptr) const;

 private:
  ReliefModel(Surface surface, HeightSystem system);

  Surface surface_;
  HeightSystem system_;
  std::vector<float> boundary_weight_;  // for the default width
};

}  // namespace relievo
