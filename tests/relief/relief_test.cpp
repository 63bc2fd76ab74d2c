#include "relievo/relief/relief.h"

#include "support/differences.h"
#include "support/same_bits.h"
#include "support/surfaces.h"

namespace relievo {
namespace {

using test::bumps_behind_a_ring, test::prepared;

const Compression keep_all{std::numeric_limits<double>::infinity(), 0};

TEST(Relief, OfAPlaneIsFlat) {
  for (const double w : {0.0, std::numeric_limits<double>::infinity()})
    EXPECT_NEAR(prepared(test::sheet(3000, 1, 2)).make({{w, 0}, .04}).height, 0, 1e-12);
}

TEST(Relief, OfATiltedPlaneIsFlatWhereNothingIsKept) {
  const Cloud tilted = test::height_field(
      3000, 1, [](double x, double) { return .5 * x; }, [](double, double) { return Vec2(.5, 0); });
  const ReliefModel model = prepared(tilted);
  EXPECT_NEAR(model.make({{0, 0}, 0}).height, 0, 1e-12);
  // Even if all slopes are kept, the relief stays low: its boundary has the height 0, so the relief cannot
  // follow the slope of the plane everywhere, and the least squares spread the error.
  EXPECT_LT(model.make({keep_all, 0}).height, .2);
}

// All slopes are kept, except that the boundary weight lowers the steep rim, which is two rho wide. So the
// difference between heights and depths must be a constant.
TEST(Relief, OfAHemisphereKeptInFullIsTheHemisphere) {
  const ReliefModel model = prepared(test::sphere(120000, 1));
  const Relief relief = model.make({keep_all, 0, 100});
  const auto [lowest, highest] = [&] {
    double low = 1, high = -1;
    for (std::size_t i = 0; i < relief.heights.size(); ++i) {
      if (model.surface().points[i].head<2>().norm() > .9) continue;
      const double offset = relief.heights[i] - model.surface().points[i].z();
      low = std::min(low, offset), high = std::max(high, offset);
    }
    return std::pair(low, high);
  }();
  EXPECT_LT(highest - lowest, .01);
  EXPECT_NEAR(relief.height, 1, .25);
}

TEST(Relief, RisesWithU) {
  const ReliefModel model = prepared(bumps_behind_a_ring());
  double last = 0;
  for (const double u : {.05, .2, 1.0, 3.0}) {
    const double height = model.make({{u, 0}, .02}).height;
    EXPECT_GT(height, last);
    last = height;
  }
}

using StyleShareBeta = std::tuple<Style, double, double>;

// Returns a name for a case. It states the style, the height in millionths of the diagonal, and beta in hundredths.
std::string name_of(const testing::TestParamInfo<StyleShareBeta>& test) {
  const auto [style, share, beta] = test.param;
  return cat(style == Style::paper_weights ? "Paper" : "Layered", "_Share", std::lround(share * 1e6),
             "ppm_Beta", std::lround(beta * 100), "pct");
}

class ReliefAtHeight : public testing::TestWithParam<StyleShareBeta> {};

TEST_P(ReliefAtHeight, IsTheHeightAsked) {
  static const ReliefModel model = prepared(bumps_behind_a_ring());
  const auto [style, share, beta] = GetParam();
  Shape shape{{1, beta}, .04};
  shape.style = style;
  const double height = share * model.surface().diagonal;
  const Relief relief = value_of(model.make_at_height(height, shape, 1));
  const auto [lowest, highest] = std::ranges::minmax(relief.heights);
  EXPECT_DOUBLE_EQ(relief.height, std::max(highest, 0.0) - std::min(lowest, 0.0));
  EXPECT_NEAR(relief.height / height, 1, style == Style::paper_weights ? 1e-3 : 1e-9);
}

constexpr auto shares = {.09, .05, .025, .0125, 1e-6};
INSTANTIATE_TEST_SUITE_P(Grid, ReliefAtHeight,
                         testing::Combine(testing::Values(Style::paper_weights), testing::ValuesIn(shares),
                                          testing::Values(0, .01, 1, 5, 50, 100)),
                         name_of);
INSTANTIATE_TEST_SUITE_P(LayeredGrid, ReliefAtHeight,
                         testing::Combine(testing::Values(Style::layered), testing::ValuesIn(shares),
                                          testing::Values(0, .01, 1)),
                         name_of);

// A sphere has no depth jumps, so steps cannot add the missing height.
TEST(Relief, TellsTheLargestHeightThatCanBeReached) {
  const ReliefModel model = prepared(test::sphere(30000, 1));
  const double most = model.make({keep_all, .04}).height;
  EXPECT_TRUE(model.make_at_height(most, {{}, .04}, 1));
  expect_error(model.make_at_height(1.01 * most, {{}, .04}, 10), ErrorKind::geometry, "at most");
}

// At high saturation (beta), most heights would need a u above the largest double. These heights must
// be reachable, too.
TEST(Relief, HasEveryHeightUpToTheLargest) {
  const ReliefModel model = prepared(bumps_behind_a_ring());
  for (const double beta : {0.0, 10.0, 100.0}) {
    const double most = model.make({{keep_all.u, beta}, .04}).height;
    for (const double share : {.5, .9, .99, .999, .99999}) {
      const auto relief = value_of(model.make_at_height(share * most, {{1, beta}, .04}, 1));
      EXPECT_NEAR(relief.height / (share * most), 1, 2e-5) << beta << ' ' << share;
    }
  }
}

// A few points that float in front of and beside the figure must not make the equations singular.
TEST(Relief, OfAFigureWithFloatingFragmentsExists) {
  Cloud cloud = bumps_behind_a_ring();
  test::Random random(3);
  for (const Vec3& place : {Vec3(2.5, 0, 1), Vec3(0, 2.6, -3), Vec3(0, 0, 4)})
    for (int i = 0; i < 12; ++i)
      test::add(cloud, place + .03 * Vec3(random.uniform(-1, 1), random.uniform(-1, 1), 0), {0, 0, 1});
  const ReliefModel model = prepared(cloud);
  const Relief relief = model.make_at_height(.1, {}, 1).value();
  for (const double z : relief.heights) ASSERT_TRUE(std::isfinite(z));
  EXPECT_EQ(relief.height, .1);
}

TEST(Relief, OfTheSubspaceIsCloseAndAsHighAsAsked) {
  const Surface surface = find_surface(bumps_behind_a_ring(), {}).value();
  const auto relief = [&](Mode mode) {
    return ReliefModel::prepare(surface, nullptr, {mode})->make_at_height(.2, {{1, .01}, .04}, 1).value();
  };
  const Relief exact = relief(Mode::exact), close = relief(Mode::subspace);
  EXPECT_EQ(exact.heights, relief(Mode::automatic).heights);
  EXPECT_EQ(close.height, .2);
  EXPECT_LT(test::root_mean_square(exact.heights, close.heights), .02 * exact.height);
}

// Only slopes matter, so the relief must not depend on the depth of a jump. tests/relief/depth_jumps_test.cpp
// tests bounds of the steps that remain.
TEST(Relief, OfATiltedFlapDoesNotDependOnItsDistance) {
  const auto relief_at = [](double distance) {
    return prepared(test::flap_before_a_sheet(8000, distance)).make({{1, .01}, 0});
  };
  const Relief near = relief_at(1);
  EXPECT_GT(near.height, .1);
  for (const double distance : {2.0, 30.0}) {
    const Relief far = relief_at(distance);
    EXPECT_NEAR(far.height, near.height, .03 * near.height) << distance;
  }
}

TEST(Relief, HasAModelForAllMethodsButThePapers) {
  const ReliefModel model = prepared(bumps_behind_a_ring());
  for (const MethodInfo& info : methods)
    EXPECT_EQ(model.serves(info.method), info.method != Method::paper) << info.name;
}

// The search for a height relies on heights that grow with u.
TEST(Relief, OfTheLayeredStyleGrowsWithU) {
  const ReliefModel model = prepared(bumps_behind_a_ring());
  EXPECT_DOUBLE_EQ(usual_height_share(0), .4);
  EXPECT_EQ(usual_height_share(std::numeric_limits<double>::infinity()), 1);
  double last = 0;
  for (const double u : {.05, .2, .5, 1.0, 2.0, 5.0, 20.0, 100.0}) {
    Shape shape = layered_shape();
    shape.compression.u = u;
    const double height = model.make(shape).height;
    EXPECT_GT(height, 1.01 * last) << u;
    last = height;
  }
}

TEST(Relief, ScalesWithTheCloud) {
  Cloud cloud = bumps_behind_a_ring();
  const ReliefModel model = prepared(cloud);
  for (Vec3& p : cloud.points) p *= 4;
  const ReliefModel scaled = prepared(cloud);
  const Shape shape{{1, .01}, .02};
  std::vector<double> heights = model.make(shape).heights;
  for (double& height : heights) height *= 4;
  EXPECT_LT(test::largest_difference(scaled.make(shape).heights, heights), 1e-9);
}

TEST(Relief, DoesNotChangeWithTheOrderOfThePoints) {
  Cloud cloud = bumps_behind_a_ring();
  const ReliefModel model = prepared(cloud);
  std::reverse(cloud.points.begin(), cloud.points.end());
  std::reverse(cloud.normals.begin(), cloud.normals.end());
  const ReliefModel reversed = prepared(cloud);
  const Shape shape{{1, .01}, .02};
  EXPECT_EQ(model.make(shape).heights, reversed.make(shape).heights);
}

// All coordinates are multiples of 2^-20. So the shift is exact, and rounding cannot change which points are visible.
TEST(Relief, DoesNotChangeWithTheOrigin) {
  Cloud cloud = bumps_behind_a_ring();
  for (Vec3& p : cloud.points) p = (p * 0x1p20).array().round() * 0x1p-20;
  const ReliefModel model = prepared(cloud);
  for (Vec3& p : cloud.points) p += Vec3(1 << 20, -(1 << 21), 1 << 20);
  const ReliefModel moved = prepared(cloud);
  const Shape shape{{1, .01}, .02};
  EXPECT_EQ(model.make(shape).heights, moved.make(shape).heights);
}

TEST(Relief, TurnsWithTheCloud) {
  const Cloud cloud = bumps_behind_a_ring();
  View quarter;
  quarter.R_view_model << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  const ReliefModel model = prepared(cloud),
                    turned = ReliefModel::prepare(test::surface_of(cloud, quarter)).value();
  EXPECT_NEAR(static_cast<double>(turned.surface().points.size()),
              static_cast<double>(model.surface().points.size()),
              .001 * static_cast<double>(model.surface().points.size()));
  const Shape shape{{1, 0}, 0};
  EXPECT_NEAR(model.make(shape).height / turned.make(shape).height, 1, .02);
}

TEST(Relief, HasTheSameBitsForAnyNumberOfThreads) {
  const Cloud cloud = bumps_behind_a_ring();
  test::expect_same_for_any_threads([&] { return prepared(cloud).make({{1, .01}, .02}).heights; });
}

}  // namespace
}  // namespace relievo
