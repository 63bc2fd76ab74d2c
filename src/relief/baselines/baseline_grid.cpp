#include "relievo/relief/baseline_grid.h"

#include <algorithm>
#include <functional>

#include "relief/baselines/bounded_reliefs.h"
#include "relief/baselines/normal_layers.h"
#include "relief/baselines/scaled.h"
#include "relief/height_search.h"
#include "relievo/core/parallel.h"
#include "relievo/core/text.h"
#include "relievo/quality/measures.h"

namespace relievo {
namespace {

// The inputs of a baseline's parameter grid. All reliefs have the height `height`. `add` is called once for
// each relief, with its parameters as text and its heights, one per point.
struct GridInput {
  const Surface& surface;
  const HeightSystem& system;
  double height;
  const std::function<void(std::string, std::vector<double>)>& add;
};

Result<void> add_linear(const GridInput& in) {
  in.add("", depths(in.surface));
  return {};
}

Result<void> each_equalised(const GridInput& in) {
  for (const double clip : {4.0, 12.0, 36.0, 108.0})
    for (const int windows : {1, 2, 3})
      in.add(cat("clip ", clip, ", windows ", windows),
             equalised_heights(in.surface, {.windows = windows, .clip = clip}));
  return {};
}

Result<void> each_gradient(const GridInput& in) {
  const std::array<std::vector<double>, 5> bands{
      {{1}, {1, 1, .8, .6}, {1, .8, .5, .3}, {1, .6, .3, .1}, {1, .4, .1, .05}}};
  for (const double attenuation : {1.0, 2.5, 5.0, 10.0, 20.0, 40.0})
    for (const std::vector<double>& weights : bands) {
      std::string parameters = cat("attenuation ", attenuation, ", bands");
      for (const double weight : weights) parameters += cat(" ", weight);
      in.add(std::move(parameters),
             gradient_heights(in.surface, in.system, {.attenuation = attenuation, .band_weights = weights}));
    }
  return {};
}

Result<void> each_detail(const GridInput& in) {
  for (const double amplification : {5.0, 10.0, 20.0, 40.0})
    for (const double scale : {.01, .02, .04, .08, .16})
      in.add(
          cat("amplification ", amplification, ", scale ", scale),
          base_and_detail_heights(in.surface, in.system, {.amplification = amplification, .scale = scale}));
  return {};
}

Result<void> add_mimicking(const GridInput& in) {
  RELIEVO_TRY(std::vector<double> heights, mimicking_heights(in.surface, in.height));
  in.add("", std::move(heights));
  return {};
}

Result<void> each_of_normal_layers(const GridInput& in) {
  std::vector<Vec2> slopes(in.surface.points.size());
  std::vector<double> heights(slopes.size());
  for (const double scale : {.01, .02, .04, .08}) {
    const std::vector<Vec3f> bases = base_normals(in.surface, scale);
    for (const double base : {0.0, .125, .25, .5}) {
      parallel_for(slopes.size(), [&](std::size_t i) {
        slopes[i] = moderate_slope(weighted_normal(in.surface.normals[i], bases[i], {.base = base}));
      });
      in.system.solve(slopes, heights);
      in.add(cat("scale ", scale, ", base ", base), heights);
    }
  }
  return {};
}

Result<void> each_bounded(const GridInput& in) {
  for (const double weight : {.1, .2, .45, .7, 1.0}) {
    RELIEVO_TRY(std::vector<double> heights, bounded_heights(in.surface, in.height, weight));
    in.add(cat("weight ", weight), std::move(heights));
  }
  return {};
}

// A baseline, and the function that adds its reliefs for all parameters of its grid.
struct BaselineGrid {
  std::string_view name;
  Result<void> (*add_all)(const GridInput&);
};
constexpr std::array<BaselineGrid, 7> grids{{{"linear", add_linear},
                                             {"equalise", each_equalised},
                                             {"gradient", each_gradient},
                                             {"detail", each_detail},
                                             {"mimicking", add_mimicking},
                                             {"normal-layers", each_of_normal_layers},
                                             {"bounded", each_bounded}}};

}  // namespace

std::vector<std::string_view> baseline_names() {
  std::vector<std::string_view> names;
  for (const BaselineGrid& grid : grids) names.push_back(grid.name);
  return names;
}

std::vector<std::string_view> compared_methods() {
  std::vector<std::string_view> names;
  for (const MethodInfo& info : methods)
    if (!info.make) names.push_back(info.name);
  for (const BaselineGrid& grid : grids) names.push_back(grid.name);
  return names;
}

Result<TunedRelief> best_baseline(std::string_view name, const BaselineInput& input, double height,
                                  double unit_mm) {
  TunedRelief best{{}, {}, -2};  // any similarity is greater
  const std::function<void(std::string, std::vector<double>)> add = [&](std::string parameters,
                                                                        std::vector<double> heights) {
    Relief relief = scaled_relief(std::move(heights), input.surface, height);
    if (!(relief.height > 0)) return;
    const double shading = input.metrics.shading(relief.heights);
    if (shading > best.shading) best = {std::move(relief), std::move(parameters), shading};
  };
  RELIEVO_CHECK(std::ranges::find(grids, name, &BaselineGrid::name)
                    ->add_all({input.surface, input.system, height, add}));
  if (!(best.relief.height > 0)) return out_of_reach(0, height * unit_mm);
  return best;
}

}  // namespace relievo
