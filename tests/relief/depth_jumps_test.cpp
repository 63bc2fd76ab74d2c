// Measures the steps that reliefs have at depth jumps between two parts (section 4.1 of the paper).
#include "relievo/relief/baselines.h"
#include "scan/jumps.h"
#include "scan/measured_cloud.h"
#include "support/surfaces.h"

namespace relievo {
namespace {

struct Scene {
  const char* name;
  Cloud cloud;
};

// Returns clouds in which one part is in front of another one. Both parts are tilted or round,
// because level parts would show no step with any method. The rear sheet has `points` points.
std::vector<Scene> scenes(std::size_t points) {
  const auto before = [](const Cloud& back, const Cloud& front) {
    return test::joined(back, test::moved(front, Vec3(0, 0, 3)));
  };
  const Cloud sheet = test::sheet(points, .8, 0),
              flap = test::turned(test::sheet(points / 2, .5, 0, 9), 25, Vec3::UnitY());
  return {{"flap before a sheet", before(sheet, flap)},
          {"flap before a tilted sheet", before(test::turned(sheet, 20, Vec3::UnitX()), flap)},
          {"hemisphere before a sheet", before(sheet, test::sphere(points, .5))}};
}

// Statistics of the steps along edges that cross deep depth jumps, as fractions of the relief's height. An
// edge is inverted if its front end is lower than its back end by more than 3 % of the height.
struct Steps {
  double mean = 0, most = 0, inverted = 0;
};

Steps steps_of(const Surface& surface, const Relief& relief) {
  double edges = 0, sum = 0, most = 0, inverted = 0;
  for (std::size_t t = 0; t < surface.triangulation.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3 && surface.boundary.is_inside[t]; ++i) {
      Index back = surface.triangulation.triangles[t][i],
            front = surface.triangulation.triangles[t][(i + 1) % 3];
      if (surface.points[front].z() < surface.points[back].z()) std::swap(front, back);
      const double depth = surface.points[front].z() - surface.points[back].z();
      if (!is_jump(surface, back, front) || depth < .02 * surface.longer_side()) continue;
      const double step = (relief.heights[front] - relief.heights[back]) / relief.height;
      ++edges;
      sum += std::abs(step);
      most = std::max(most, std::abs(step));
      inverted += step < -.03;
    }
  return {sum / edges, most, inverted / edges};
}

// A jump leaves only a height difference between neighbouring points, which decreases as the points become denser.
TEST(DepthJumps, VanishByThePapersMethod) {
  const View view = View().for_paper();
  const auto steps_in = [&](const Cloud& cloud) {
    const ReliefModel model =
        value_of(ReliefModel::of_view(*value_of(MeasuredCloud::measure(cloud, view)), view, {}));
    return steps_of(model.surface(), model.make({Compression::from_alpha(4, .01)}));
  };
  const std::vector<Scene> sparse = scenes(15000), dense = scenes(60000);
  for (std::size_t i = 0; i < dense.size(); ++i) {
    const Steps steps = steps_in(dense[i].cloud), before = steps_in(sparse[i].cloud);
    EXPECT_LT(steps.mean, .03) << dense[i].name;
    EXPECT_LT(steps.inverted, .05) << dense[i].name;
    EXPECT_LT(steps.mean, .75 * before.mean) << dense[i].name;
  }
}

// For other methods, only bounds of the steps are tested. Layered reliefs have steps on purpose.
TEST(DepthJumps, LeaveBoundedStepsByOtherMethods) {
  for (const auto& [name, cloud] : scenes(15000)) {
    const ReliefModel model = test::prepared(cloud);
    const double height = .05 * model.surface().longer_side();
    const Steps layered =
                    steps_of(model.surface(), value_of(model.make_at_height(height, layered_shape(), 1))),
                gradient = steps_of(model.surface(), gradient_relief(model, height));
    EXPECT_LT(layered.most, .3) << name;
    EXPECT_LT(layered.inverted, .05) << name;
    EXPECT_LT(gradient.most, .21) << name;
    EXPECT_LT(gradient.inverted, .5) << name;
  }
}

}  // namespace
}  // namespace relievo
