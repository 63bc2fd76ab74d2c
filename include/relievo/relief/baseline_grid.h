// Baselines as strong as their authors would run them: without jump weights, and with the parameters of a
// grid that serve a relief best. `compare` and docs/quality.md show these. Methods of the same name have
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

// Const calls may run concurrently.
class BaselineGrid {
 public:
  // Keeps a reference to the surface, which must outlive this object. Errors: those of HeightSystem::build().
  static Result<BaselineGrid> prepare(const Surface& surface);

  // Returns the relief of the grid with the best shading. `name` is one of baseline_names. Errors: kind
  // geometry if the baseline has no height to scale; the message states heights in millimetres, `unit_mm` per
  // unit.
  Result<TunedRelief> best(std::string_view name, const ReliefMetrics& metrics, double height,
                           double unit_mm) const;

 private:
  BaselineGrid(const Surface& surface, HeightSystem system)
      : surface_(&surface), system_(std::move(system)) {}

  const Surface* surface_;
  HeightSystem system_;
};

}  // namespace relievo
