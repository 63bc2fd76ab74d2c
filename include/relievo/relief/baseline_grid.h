// Baselines as strong as their authors would run them: with the parameters of a grid that serve a relief
// best. `compare` and docs/quality.md show these. Methods of the same name have
// fixed parameters.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "relievo/core/error.h"
#include "relievo/relief/heights.h"
#include "relievo/relief/relief.h"

namespace relievo {

class ReliefMetrics;

// Four are methods; docs/quality.md says what the others are.
inline constexpr std::array<std::string_view, 7> baseline_names{
    "linear", "equalise", "gradient", "detail", "mimicking", "normal-layers", "bounded"};

// Returns the names of all that `compare` shows: the methods with a shape, then the baselines.
std::vector<std::string_view> compared_methods();

struct TunedRelief {
  Relief relief;
  std::string parameters;  // of the grid: "attenuation 5, bands 1 1 0.8 0.6"; empty if the baseline has none
  double shading = 0;      // Measures::shading
};

// Returns the relief of the baseline's grid with the best shading. `name` is one of baseline_names, and
// `system` that of all points of the surface. Errors: kind geometry if the baseline has no height to scale;
// the message states heights in millimetres, `unit_mm` per unit.
struct BaselineInput {
  const Surface& surface;
  const HeightSystem& system;
  const ReliefMetrics& metrics;
};
Result<TunedRelief> best_baseline(std::string_view name, const BaselineInput& input, double height,
                                  double unit_mm);

}  // namespace relievo
