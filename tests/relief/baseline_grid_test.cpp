#include "relievo/relief/baseline_grid.h"

#include "relief/baselines/scaled.h"
#include "relievo/quality/measures.h"
#include "support/surfaces.h"

namespace relievo {
namespace {

// A surface, with the equation system and the quality metrics that baselines need.
struct Seen {
  Surface surface;
  HeightSystem system;
  ReliefMetrics metrics;

  explicit Seen(const Cloud& cloud)
      : surface(test::surface_of(cloud)),
        system(
            value_of(HeightSystem::build(in_plane(surface.points), surface.triangulation, surface.boundary))),
        metrics(surface) {}
  BaselineInput input() const { return {surface, system, metrics}; }
};

TEST(BaselineGrid, HasTheHeightAskedAndLiesOnTheBase) {
  const Seen seen(test::bumps_behind_a_ring(8000));
  const auto& [surface, system, metrics] = seen;
  for (const std::string_view name : baseline_names()) {
    const TunedRelief best = value_of(best_baseline(name, seen.input(), .05, 1));
    EXPECT_EQ(best.parameters.empty(), name == "linear" || name == "mimicking") << name;
    EXPECT_EQ(best.shading, metrics.measure(best.relief.heights).shading) << name;
    const auto [low, high] = std::ranges::minmax(best.relief.heights);
    EXPECT_NEAR(std::max(high, 0.0) - std::min(low, 0.0), .05, 1e-12) << name;
    for (std::size_t i = 0; i < surface.points.size(); ++i)
      ASSERT_TRUE(!surface.boundary.is_boundary[i] || best.relief.heights[i] == 0) << name;
  }
}

// The grid includes the fixed parameters of the methods, so its best relief cannot be worse.
TEST(BaselineGrid, IsAtLeastAsGoodAsTheFixedParameters) {
  const Seen seen(test::bumps_behind_a_ring(8000));
  const auto& [surface, system, metrics] = seen;
  const auto expect_better = [&](std::string_view name, std::vector<double> fixed) {
    const Relief relief = scaled_relief(std::move(fixed), surface, .1);
    EXPECT_GE(value_of(best_baseline(name, seen.input(), .1, 1)).shading, metrics.shading(relief.heights))
        << name;
  };
  expect_better("gradient", gradient_heights(surface, system, {}));
  expect_better("detail", base_and_detail_heights(surface, system, {}));
  expect_better("equalise", equalised_heights(surface, {}));
}

TEST(BaselineGrid, RefusesAHeightThatNothingHas) {
  const Seen seen(test::sheet(2000, 1, 0));
  for (const std::string_view name : baseline_names()) {
    SCOPED_TRACE(name);
    expect_error(best_baseline(name, seen.input(), .1, 20), ErrorKind::geometry,
                 "this view shows a level face alone");
  }
}

TEST(ComparedMethods, AreThoseWithAShapeAndTheBaselines) {
  const std::vector<std::string_view> names = compared_methods();
  EXPECT_EQ(names.size(), 2 + baseline_names().size());
  for (const MethodInfo& info : methods)
    EXPECT_NE(std::ranges::find(names, info.name), names.end()) << info.name;
}

}  // namespace
}  // namespace relievo
