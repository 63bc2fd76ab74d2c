#include "relievo/relief/baselines.h"

#include "support/differences.h"
#include "support/least_squares.h"
#include "support/surfaces.h"

namespace relievo {
namespace {

// Returns a roof with sides of the given slope. Its ridge runs along y.
Cloud roof(double slope, std::size_t n = 30000) {
  return test::height_field(
      n, 1, [=](double x, double) { return -slope * std::abs(x); },
      [=](double x, double) { return Vec2(x > 0 ? -slope : slope, 0); });
}

// Returns the range of the difference between the heights and f, as a fraction of the relief's height.
// Points near the rim do not count.
template <typename F>
double misfit(const Surface& surface, const Relief& relief, F f) {
  double low = 1e300, high = -1e300;
  for (std::size_t i = 0; i < relief.heights.size(); ++i) {
    const Vec3& p = surface.points[i];
    if (std::abs(p.x()) > .8 || std::abs(p.y()) > .8) continue;
    const double offset = relief.heights[i] - f(p);
    low = std::min(low, offset), high = std::max(high, offset);
  }
  return (high - low) / relief.height;
}

TEST(MakeByMethod, RefusesWhatASubspaceCannotSolve) {
  const ReliefModel model = test::prepared(test::sphere(20000, 1), Mode::subspace);
  for (const MethodInfo& info : methods) {
    const auto relief = make_by_method(info.method, model, .05, default_shape(info.method), 1);
    ASSERT_EQ(relief.has_value(), !info.needs_all_points) << info.name;
    EXPECT_TRUE(relief || relief.error().kind == ErrorKind::option);
  }
}

// All points of a level face have the same depth. All points of a cloud of four points are on the boundary.
// So no method gives either cloud a height.
TEST(MakeByMethod, RefusesAHeightThatNothingHas) {
  Cloud four{.points = {{0, 0, 0}, {1, 0, 1}, {0, 1, 2}, {1, 1, 0}}};
  for (const Cloud& cloud : {roof(0, 1000), four}) {
    const ReliefModel model = test::prepared(cloud);
    for (const MethodInfo& info : methods) {
      SCOPED_TRACE(info.name);
      expect_error(make_by_method(info.method, model, .1, default_shape(info.method), 20),
                   ErrorKind::geometry,
                   "expected a height that can be reached, at most 0 mm for this view and width, found 2 mm: "
                   "this view shows a level face alone; choose another");
    }
  }
}

TEST(Linear, IsTheDepthScaled) {
  const Surface surface = test::surface_of(test::sphere(20000, 1));
  const Relief relief = linear_relief(surface, .1);
  double lowest = 1, highest = -1;
  for (std::size_t i = 0; i < relief.heights.size(); ++i) {
    const double z = surface.points[i].z();
    lowest = std::min(lowest, z);
    if (!surface.boundary.is_boundary[i]) highest = std::max(highest, z);
  }
  for (std::size_t i = 0; i < relief.heights.size(); ++i) {
    const double scaled = .1 * (surface.points[i].z() - lowest) / (highest - lowest);
    ASSERT_NEAR(relief.heights[i], surface.boundary.is_boundary[i] ? 0 : scaled, 1e-12);
  }
}

TEST(Attenuated, IsTheLogarithmAlongTheGradient) {
  for (const double a : {.1, 1.0, 30.0})
    for (const double length : {1e-9, .3, 5.0, 1e3}) {
      const Vec2 g = attenuated(length * Vec2(.6, -.8), a);
      EXPECT_NEAR(g.norm(), std::log(1 + a * length) / a, 1e-9 * length + 1e-15);
      EXPECT_NEAR(g.x() * -.8, g.y() * .6, 1e-12 * length);
    }
  EXPECT_EQ(attenuated(Vec2::Zero(), 5), Vec2(Vec2::Zero()));
}

// The expected heights are computed as by Weyrich et al.: attenuated gradients are integrated, and the
// result is scaled. The test uses another solver than the library. A sphere has no depth jumps, so all
// edges have the same weight.
TEST(Gradient, IntegratesAttenuatedGradients) {
  const ReliefModel model = test::prepared(test::sphere(20000, 1));
  const GradientOptions options{.attenuation = 3, .steepest_kept = 50, .band_weights = {1}};
  const Relief relief = gradient_relief(model, .1, options);
  std::vector<Vec2> slopes;
  for (const Vec3f& n : model.surface().normals) {
    const Vec2 g = -n.head<2>().cast<double>() / static_cast<double>(n.z());
    slopes.push_back(g.norm() > 50 ? Vec2(Vec2::Zero())
                                   : Vec2(g.normalized() * std::log(1 + 3 * g.norm()) / 3));
  }
  const Surface& surface = model.surface();
  const std::vector<double> heights = test::least_squares_heights(
      {in_plane(surface.points), surface.triangulation, surface.boundary}, slopes);
  const double highest = *std::ranges::max_element(heights);
  for (std::size_t i = 0; i < heights.size(); ++i)
    ASSERT_NEAR(relief.heights[i], .1 * heights[i] / highest, 1e-6);
}

// All slopes are equal, so attenuation only scales the relief. Beside the outline and the ridge, normals
// are interpolated, so there the slopes are equal only to about three digits.
TEST(Gradient, OfEvenSlopesIsTheDepthScaled) {
  const ReliefModel model = test::prepared(roof(.5));
  const GradientOptions options{.attenuation = 5, .steepest_kept = 100, .band_weights = {1}};
  const Relief attenuated_roof = gradient_relief(model, .1, options);
  const Relief plain_roof =
      gradient_relief(model, .1, {.attenuation = 1e-9, .steepest_kept = 100, .band_weights = {1}});
  EXPECT_LE(test::largest_difference(attenuated_roof.heights, plain_roof.heights), 1e-4);
}

TEST(Gradient, EqualBandWeightsChangeNothing) {
  const ReliefModel model = test::prepared(test::sphere(20000, 1));
  GradientOptions options{.band_weights = {1}};
  const Relief one = gradient_relief(model, .1, options);
  options.band_weights = {1, 1, 1, 1};
  const Relief four = gradient_relief(model, .1, options);
  EXPECT_LE(test::largest_difference(one.heights, four.heights), 1e-6);
}

TEST(Gradient, RemovesSilhouettes) {
  const ReliefModel model = test::prepared(test::height_field(
      20000, 1, [](double x, double) { return 3 * x; }, [](double, double) { return Vec2(3, 0); }));
  EXPECT_EQ(gradient_relief(model, .1, {.attenuation = 5, .steepest_kept = 2.9, .band_weights = {1}}).height,
            0);
  EXPECT_NEAR(
      gradient_relief(model, .1, {.attenuation = 5, .steepest_kept = 3.1, .band_weights = {1}}).height, .1,
      1e-12);
}

TEST(Equalise, OfDepthsSpreadEvenlyIsLinear) {
  const Cloud ramp = test::height_field(
      40000, 1, [](double x, double) { return x; }, [](double, double) { return Vec2(1, 0); });
  const Surface surface = test::surface_of(ramp);
  EqualiseOptions options{.picture_px = 128, .windows = 1};
  options.largest_window_px = 1024;  // the window is the whole picture
  const Relief relief = equalised_relief(surface, 1, options);
  EXPECT_LT(misfit(surface, relief, [](const Vec3& p) { return .5 * p.z(); }), .03);
}

// The cloud consists of two gentle slopes at different depths. Equalisation must shrink the range between
// these depths, which has no points.
TEST(Equalise, ShrinksDepthsThatNothingHas) {
  const Cloud cloud = test::joined(
      test::height_field(
          40000, 1, [](double x, double) { return .3 * x; }, [](double, double) { return Vec2(.3, 0); }),
      test::height_field(
          10000, .5, [](double x, double) { return 5 + .3 * x; }, [](double, double) { return Vec2(.3, 0); },
          9));
  const Surface surface = test::surface_of(cloud);
  const double linear_gap = 5 - .3 * 1.5;
  const auto gap = [&](const Relief& relief) {
    double below = 0, above = 1e300;
    for (std::size_t i = 0; i < relief.heights.size(); ++i) {
      if (surface.boundary.is_boundary[i]) continue;
      const double z = surface.points[i].z() + surface.centre.z();
      if (z < 1) below = std::max(below, relief.heights[i]);
      if (z > 1) above = std::min(above, relief.heights[i]);
    }
    return (above - below) / relief.height;
  };
  EXPECT_NEAR(gap(linear_relief(surface, 1)), linear_gap / (5 + .45), .1);
  EXPECT_LT(gap(equalised_relief(surface, 1, {.clip = 50})), .5 * gap(linear_relief(surface, 1)));
}

TEST(BaseAndDetail, WithoutAmplificationIsLinear) {
  const ReliefModel model = test::prepared(test::sphere(20000, 1));
  const Relief linear = linear_relief(model.surface(), .1);
  const Relief base = base_and_detail_relief(model, .1, {.amplification = 0});
  EXPECT_LE(test::largest_difference(base.heights, linear.heights), 1e-9);
}

// The surface is a fine wave on a coarse wave. The Gaussian leaves the coarse wave in the base, so the
// method amplifies only the fine wave.
TEST(BaseAndDetail, AmplifiesWhatIsFine) {
  const auto z = [](double x, double) { return .2 * std::cos(3 * x) + .004 * std::cos(60 * x); };
  const auto gradient = [](double x, double) {
    return Vec2(-.6 * std::sin(3 * x) - .24 * std::sin(60 * x), 0);
  };
  const ReliefModel model = test::prepared(test::height_field(80000, 1, z, gradient));
  const auto wave = [&](double frequency, const Relief& relief) {
    double sum = 0, weight = 0;
    for (std::size_t i = 0; i < relief.heights.size(); ++i) {
      const Vec3& p = model.surface().points[i];
      if (std::abs(p.x()) > .8 || std::abs(p.y()) > .8) continue;
      const double c = std::cos(frequency * (p.x() + model.surface().centre.x()));
      sum += c * relief.heights[i], weight += c * c;
    }
    return sum / weight;
  };
  const auto fine_share = [&](double amplification) {
    const Relief relief = base_and_detail_relief(model, .1, {.amplification = amplification, .scale = .05});
    return wave(60, relief) / relief.height;
  };
  EXPECT_GT(fine_share(5), 3 * fine_share(0));
}

TEST(Baselines, AreTheHeightAskedAndLieOnTheBase) {
  const ReliefModel model = test::prepared(test::torus(30000, 1, .4));
  for (const MethodInfo& info : methods) {
    const Result<Relief> relief = make_by_method(info.method, model, .05, default_shape(info.method), 1);
    ASSERT_TRUE(relief) << info.name;
    const auto [low, high] = std::ranges::minmax(relief->heights);
    EXPECT_NEAR(std::max(high, 0.0) - std::min(low, 0.0), .05, 1e-6) << info.name;
    for (std::size_t i = 0; i < relief->heights.size(); ++i)
      ASSERT_TRUE(!model.surface().boundary.is_boundary[i] || relief->heights[i] == 0) << info.name;
  }
}

TEST(Method, NamesLeadBack) {
  for (const MethodInfo& info : methods) {
    EXPECT_EQ(parse_method(info.name), info.method);
    EXPECT_EQ(name_of(info.method), info.name);
  }
  const std::string message = parse_method("carving").error().message();
  EXPECT_TRUE(message.starts_with("method: expected one of layered, paper, linear, ")) << message;
  EXPECT_TRUE(message.ends_with(", found 'carving'")) << message;
}

}  // namespace
}  // namespace relievo
