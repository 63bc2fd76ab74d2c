// Baselines at their best: each relief uses the parameters of a grid that give it the best shading. The
// program's command `compare` and docs/quality.md show these. The methods with the same names have fixed
// parameters.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "relievo/core/error.h"
#include "relievo/relief/heights.h"
#include "relievo/relief/relief.h"

namespace relievo {

class ReliefMetrics;

// Returns the names of all baselines. Four of them are also methods; docs/quality.md describes the others.
std::vector<std::string_view> baseline_names();

// Returns the names of everything that `compare` shows: the methods with a shape, then the baselines.
std::vector<std::string_view> compared_methods();

struct TunedRelief {
  Relief relief;
  // Parameters of the grid, such as "attenuation 5, bands 1 1 0.8 0.6"; empty if the baseline has none.
  std::string parameters;
  double shading = 0;  // Measures::shading
};

// Returns the relief of the baseline's grid with the best shading. `name` is one of baseline_names(); `system`
// is the system of all points of the surface. Errors: kind geometry if the baseline has no height that could
// be scaled. Messages give heights in millimetres; one unit is `unit_mm`.
struct BaselineInput {
  const Surface& surface;
  const HeightSystem& system;
  const ReliefMetrics& metrics;
};
Result<TunedRelief> best_baseline(std::string_view name, const BaselineInput& input, double height,
                                  double unit_mm);

}  // namespace relievo
