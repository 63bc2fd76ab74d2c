#include "relief/own_heights.h"

#include <set>

#include "relievo/job.h"
#include "relievo/relief/draft.h"
#include "relievo/relief/relief.h"
#include "relievo/scan/surface.h"
#include "support/mesh_shapes.h"
#include "support/scene_parts.h"

namespace relievo {
namespace {

Mesh box(const Vec3& least, const Vec3& most) {
  Mesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.points.emplace_back(i & 1 ? most.x() : least.x(), i & 2 ? most.y() : least.y(),
                             i & 4 ? most.z() : least.z());
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

// Returns a mesh of the letter T, made of two bars with level faces.
Mesh letter(const Vec3& at, double size) {
  const Vec3 thick(0, 0, .1 * size);
  return test::joined(box(at + Vec3(-.5, .7, 0) * size, at + Vec3(.5, 1, 0) * size + thick),
                      box(at + Vec3(-.15, 0, 0) * size, at + Vec3(.15, .7, 0) * size + thick));
}

SceneModel model(const Mesh& mesh, std::optional<double> height = {}) {
  Pose pose = test::at(0, 0, 0);
  pose.height = height;
  return test::model_of(mesh, pose);
}

Mesh head() {
  return test::sphere_mesh(1, 96);
}

Scene legend_beside_head(std::optional<double> height) {
  return {
      {model(head()), model(test::joined(letter({1.5, 0, -.5}, .6), letter({-1.6, -.8, -.5}, .5)), height)}};
}

Scene letter_before_head(std::optional<double> height) {
  return {{model(head()), model(letter({.4, -.6, .9}, .5), height)}};
}

LiveModel prepared(const Scene& scene) {
  Job job{scene};
  job.options.points = 40'000;
  return value_of(prepare(job));
}

constexpr double height = .2;  // height of the whole relief, in the units of the scene

Relief relief_of(const LiveModel& live, double total = height) {
  return value_of(live.model().make_at_height(total, layered_shape(), 1));
}

// Returns the largest height of the relief at the points for which `is_wanted` returns true.
template <typename F>
double highest(const Relief& relief, F is_wanted) {
  double most = 0;
  for (std::size_t i = 0; i < relief.heights.size(); ++i)
    if (is_wanted(i)) most = std::max(most, relief.heights[i]);
  return most;
}

bool is_own(const LiveModel& live, std::size_t i) {
  const std::vector<float>& own = live.model().surface().own_heights;
  return !own.empty() && own[i] > 0;
}

TEST(OwnHeights, LettersOnTheGroundHaveTheHeightAskedFor) {
  for (const double share : {.05, .2, .5}) {
    const LiveModel live = prepared(legend_beside_head(share));
    const Relief relief = relief_of(live);
    const Surface& surface = live.model().surface();
    EXPECT_NEAR(relief.height, height, 1e-12);
    for (const double side : {-1., 1.}) {
      const auto is_letter = [&](std::size_t i) {
        return is_own(live, i) && side * surface.points[i].x() > 0;
      };
      EXPECT_NEAR(highest(relief, is_letter), share * height, .05 * share * height) << share << side;
    }
  }
}

TEST(OwnHeights, LettersAreLevelAndTheirEdgeIsAWall) {
  const LiveModel live = prepared(legend_beside_head(.4));
  const Relief relief = relief_of(live);
  const Surface& surface = live.model().surface();
  for (std::size_t i = 0; i < relief.heights.size(); ++i)
    if (is_own(live, i) && surface.boundary.distance[i] > 1.5 * surface.rho)
      EXPECT_NEAR(relief.heights[i], .4 * height, 1e-6 * height);
}

TEST(OwnHeights, RefuseTheBrushThatProtects) {
  ReliefOptions options;
  options.strokes = {{"cheek", Brush::protect, 1, .2, 1, false, {Vec3(0, 0, 1)}}};
  expect_error(prepared(legend_beside_head(.3)).relief(options),
               "expected no brush protect, as a model of the scene has its own height");
  EXPECT_TRUE(prepared(legend_beside_head({})).relief(options));
}

TEST(OwnHeights, OtherModelsKeepTheirHeights) {
  const LiveModel with = prepared(legend_beside_head(.3)), without = prepared(legend_beside_head({}));
  const Relief raised = relief_of(with), usual = relief_of(without);
  ASSERT_EQ(with.model().surface().points, without.model().surface().points);
  for (std::size_t i = 0; i < usual.heights.size(); ++i)
    if (!is_own(with, i)) EXPECT_NEAR(raised.heights[i], usual.heights[i], 1e-9 * height);
}

// The letter hides the surface of the head behind it, but around the letter this surface continues evenly.
TEST(OwnHeights, ALetterBeforeAHeadStandsThatHighOverIt) {
  const double share = .25;
  const LiveModel live = prepared(letter_before_head(share));
  const Relief relief = relief_of(live);
  const Surface& surface = live.model().surface();
  EXPECT_NEAR(relief.height, height, 1e-12);
  std::vector<double> over;
  for (Index t = 0; t < surface.triangulation.triangles.size(); ++t) {
    if (!surface.boundary.is_inside[t]) continue;
    for (const Index a : surface.triangulation.triangles[t])
      for (const Index b : surface.triangulation.triangles[t])
        if (is_own(live, a) && !is_own(live, b) && surface.boundary.is_across_wall(a, b))
          over.push_back(relief.heights[a] - relief.heights[b]);
  }
  ASSERT_GT(over.size(), 100);
  std::ranges::sort(over);
  EXPECT_NEAR(over[over.size() / 2], share * height, .05 * share * height);
  EXPECT_GT(over[over.size() / 20], .8 * share * height);
}

TEST(OwnHeights, AModelThatRisesAboveTheReliefLowersTheOthers) {
  const LiveModel with = prepared(letter_before_head(.6)), without = prepared(letter_before_head({}));
  const Relief raised = relief_of(with), usual = relief_of(without);
  EXPECT_NEAR(raised.height, height, 1e-12);
  std::set<long> factors;
  for (std::size_t i = 0; i < usual.heights.size(); ++i)
    if (!is_own(with, i) && usual.heights[i] > .1 * height)
      factors.insert(std::lround(1e5 * raised.heights[i] / usual.heights[i]));
  EXPECT_LE(factors.size(), 2U);
  EXPECT_LT(*factors.begin(), 99'000);
}

TEST(OwnHeights, AFigureIsScaledAndKeepsItsForm) {
  const Scene scene{{model(head()), model(test::sphere_mesh(.4, 64), .7)}};
  Scene moved = scene;
  moved.models[1].pose.translate = Vec3(1.8, 0, 0);
  const LiveModel live = prepared(moved);
  const Relief relief = relief_of(live);
  const Surface& surface = live.model().surface();
  const auto is_within = [&](double radius) {
    return [&, radius](std::size_t i) { return is_own(live, i) && surface.boundary.distance[i] < radius; };
  };
  EXPECT_NEAR(highest(relief, is_within(9)), .7 * height, .01 * height);
  EXPECT_LT(highest(relief, is_within(1.5 * surface.rho)), .4 * height);  // there is no wall
}

TEST(OwnHeights, FramesHaveThemToo) {
  LiveModel live = prepared(letter_before_head(.3));
  Frame frame;
  FrameMaker(live.model()).make({layered_shape(), height}, frame);
  const Relief relief = relief_of(live);
  double most = 0;
  for (std::size_t i = 0; i < relief.heights.size(); ++i)
    most = std::max(most, std::abs(static_cast<double>(frame.heights[i]) - relief.heights[i]));
  EXPECT_LT(most, 2e-3 * height);
}

TEST(OwnHeights, DraftKeepsThem) {
  const double share = .2, slope = std::tan(75 * std::numbers::pi / 180);
  const LiveModel live = prepared(legend_beside_head(share));
  const DraftOrder order{Method::layered, layered_shape(), height, 1};
  const Relief relief = value_of(make_with_draft(live.model(), order, {slope, {}}));
  EXPECT_NEAR(relief.height, height, 1e-12);
  for (const double side : {-1., 1.}) {
    const auto is_letter = [&](std::size_t i) {
      return is_own(live, i) && side * live.model().surface().points[i].x() > 0;
    };
    EXPECT_NEAR(highest(relief, is_letter), share * height, .05 * share * height) << side;
  }
}

TEST(OwnHeights, BaselinesHaveThemToo) {
  const LiveModel live = prepared(legend_beside_head(.2));
  const Relief relief = value_of(make_by_method(Method::linear, live.model(), height, {}, 1));
  const auto is_letter = [&](std::size_t i) { return is_own(live, i); };
  EXPECT_NEAR(highest(relief, is_letter), .2 * height, .01 * height);
}

TEST(OwnHeights, RefusesHeightsOutOfRangeAndThePaper) {
  for (const double share : {0., .95, -1.}) {
    const auto made = prepare(Job{legend_beside_head(share)});
    expect_error(made, ErrorKind::option, "expected a height from 0.01 to 0.9 of the relief's, found ");
  }
  Job job{legend_beside_head(.2)};
  job.options.method = Method::paper;
  expect_error(prepare(job),
               "method: expected another than paper for a scene in which a model has its own height");
}

}  // namespace
}  // namespace relievo
