// Finds the best relief of each baseline: the one with the best shading among the reliefs for all parameters
// in a grid. The program's command `compare` and docs/quality.md show these reliefs. Methods with the same
// names as baselines have fixed parameters.
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
  // Parameters of the relief, such as "attenuation 5, bands 1 1 0.8 0.6"; empty if the baseline has none.
  std::string parameters;
  double shading = 0;  // Measures::shading
};

struct BaselineInput {
  const Surface& surface;
  const HeightSystem& system;
  const ReliefMetrics& metrics;
};

// Returns the relief with the best shading among the reliefs for all parameters in the baseline's grid.
// `name` is one of baseline_names(); `system` is the system of all points of the surface. Errors: kind
// geometry if the baseline's reliefs are flat and cannot be scaled. Messages give heights in millimetres;
// `unit_mm` is the number of millimetres per unit of the surface.
Result<TunedRelief> best_baseline(std::string_view name, const BaselineInput& input, double height,
                                  double unit_mm);

}  // namespace relievo
