#include "relievo/relief/draft.h"
#include "relievo/io/write.h"
#include "relievo/plate/draft_in_file.h"

#include <rapidcheck.h>

#include <cstring>

#include "relievo/make_relief.h"
#include "relievo/plate/simplify.h"
#include "support/differences.h"
#include "support/plate_fronts.h"
#include "support/same_bits.h"
#include "support/surfaces.h"

namespace relievo {
namespace {

using test::prepared;

// Returns a figure that has walls at depth jumps, curvature of both signs, and a hole.
Cloud figure(std::size_t n = 12000) {
  return test::joined(test::torus(n, 1.5, .4), test::sphere(n, .8));
}

// Returns a relief with the heights f(x, y), but 0 at the boundary.
template <typename F>
Relief relief_of(const ReliefModel& model, F f) {
  Relief relief;
  for (std::size_t i = 0; i < model.surface().points.size(); ++i) {
    const Vec3& p = model.surface().points[i];
    relief.heights.push_back(model.surface().boundary.is_boundary[i] ? 0 : f(p.x(), p.y()));
  }
  return relief;
}

struct Slope {
  Vec2 slope;
  double area;
};

// Computes the slope and the area of a triangle from its normal.
Slope slope_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 p = b - a, q = c - a;
  const Vec3 normal = p.cross(q);
  return {-normal.head<2>() / normal.z(), normal.z() / 2};
}

// Returns the slopes of the triangles that belong to the relief.
std::vector<Slope> slopes_of(const ReliefModel& model, const std::vector<double>& heights) {
  const Surface& surface = model.surface();
  std::vector<Slope> slopes;
  for (std::size_t i = 0; i < surface.triangulation.triangles.size(); ++i) {
    if (!surface.boundary.is_inside[i]) continue;
    const Triangle& t = surface.triangulation.triangles[i];
    const auto at = [&](Index p) { return Vec3(surface.points[p].x(), surface.points[p].y(), heights[p]); };
    slopes.push_back(slope_of(at(t[0]), at(t[1]), at(t[2])));
  }
  return slopes;
}

double steepest(const std::vector<Slope>& slopes) {
  double most = 0;
  for (const Slope& s : slopes) most = std::max(most, s.slope.norm());
  return most;
}

// Reads triangles from an STL file as other programs do. Returns the slope angle of the steepest
// triangle in degrees; 90 if a triangle does not face upwards.
double steepest_deg_in_stl(const std::vector<std::byte>& file, std::size_t triangles) {
  double most = 0;
  for (std::size_t t = 0; t < triangles; ++t) {
    std::array<float, 9> v{};
    std::memcpy(v.data(), file.data() + 84 + 50 * t + 12, sizeof v);
    const auto corner = [&](std::size_t i) { return Vec3(v[3 * i], v[3 * i + 1], v[3 * i + 2]); };
    const Slope s = slope_of(corner(0), corner(1), corner(2));
    if (v[2] == v[5] && v[5] == v[8]) continue;  // level; rounding may have reversed a thin triangle
    most = std::max(most, s.area > 0 ? std::atan(s.slope.norm()) * 180 / std::numbers::pi : 90.0);
  }
  return most;
}

TEST(Draft, AnglesAreMeasuredFromTheVertical) {
  EXPECT_NEAR(slope_at_draft(45), 1, 1e-15);
  EXPECT_NEAR(slope_at_draft(30), std::sqrt(3), 1e-14);
  EXPECT_GT(slope_at_draft(5), slope_at_draft(15));
}

TEST(Draft, AReliefWithinTheLimitStaysBitForBit) {
  const ReliefModel model = prepared(figure());
  Shape shape = default_shape(Method::layered);
  const Relief relief = model.make(shape);
  const DraftOptions wide{1.01 * steepest(slopes_of(model, relief.heights))};
  EXPECT_EQ(limit_draft(model, relief, wide)->heights, relief.heights);
  const auto free = make_by_method(Method::layered, model, .2, shape, 1);
  const auto limited = make_with_draft(model, {Method::layered, shape, .2}, {100});
  EXPECT_EQ(limited->heights, free->heights);
}

// If a cone is steeper than the limit, the nearest relief within the limit is the cone whose slope is the limit.
TEST(Draft, ACone) {
  const ReliefModel model = prepared(test::sheet(20000, 1, 0));
  const auto cone = [](double slope) {
    return [slope](double x, double y) { return slope * std::max(0.0, .8 - std::hypot(x, y)); };
  };
  const Relief wanted = relief_of(model, cone(1));
  const Relief limited = limit_draft(model, relief_of(model, cone(2)), {1}).value();
  EXPECT_LT(test::largest_difference(limited.heights, wanted.heights),
            .02);  // the points are 0.014 apart, so no point is at the tip
  EXPECT_LT(limited.height, .8);
}

TEST(Draft, APyramidOnAllOfTheBase) {
  const ReliefModel model = prepared(test::sheet(20000, 1, 0));
  const auto pyramid = [](double slope) {
    return [slope](double x, double y) { return slope * (1 - std::max(std::abs(x), std::abs(y))); };
  };
  const Relief wanted = relief_of(model, pyramid(.5));
  const Relief limited = limit_draft(model, relief_of(model, pyramid(3)), {.5}).value();
  EXPECT_LT(test::largest_difference(limited.heights, wanted.heights), .02);
}

// z is the nearest relief within a convex limit if and only if the following sum is not negative for any
// relief y within the limit: the sum of area (slope of z - given slope) . (slope of y - slope of z).
TEST(Draft, NoOtherReliefUnderTheLimitIsNearer) {
  const ReliefModel model = prepared(test::sheet(3000, 1, 0));
  const Relief given = relief_of(model, [](double x, double y) {
    return .5 * (1 - x * x) * (1 - y * y) * std::sin(7 * x + y) * std::cos(5 * y);
  });
  constexpr double limit = 1.5;
  std::vector<Slope> first = slopes_of(model, given.heights);
  ASSERT_GT(steepest(first), 1.5 * limit);
  for (Slope& s : first)
    if (s.slope.norm() > 2 * limit) s.slope *= 2 * limit / s.slope.norm();
  const Relief nearest = limit_draft(model, given, {limit}).value();
  const std::vector<Slope> z = slopes_of(model, nearest.heights);
  EXPECT_LE(steepest(z), limit);
  test::Random random(11);
  for (int trial = 0; trial < 40; ++trial) {
    const double a = random.uniform(1, 12), b = random.uniform(-9, 9), phase = random.uniform(0, 6);
    const double share = trial % 2 ? 1 : 0;
    Relief other = relief_of(model, [&](double x, double y) { return std::sin(a * x + b * y + phase); });
    for (std::size_t i = 0; i < other.heights.size(); ++i)
      other.heights[i] = .1 * other.heights[i] + share * given.heights[i];
    const double scale = limit / steepest(slopes_of(model, other.heights));
    for (double& height : other.heights) height *= scale;
    const std::vector<Slope> y = slopes_of(model, other.heights);
    double sum = 0, norm = 0;
    for (std::size_t t = 0; t < z.size(); ++t) {
      sum += z[t].area * (z[t].slope - first[t].slope).dot(y[t].slope - z[t].slope);
      norm += z[t].area * (z[t].slope - first[t].slope).norm() * (y[t].slope - z[t].slope).norm();
    }
    EXPECT_GT(sum, -.002 * norm);
  }
}

TEST(Draft, TheHeightIsMetExactlyByAllMethods) {
  const ReliefModel model = prepared(figure(6000));
  for (const MethodInfo& info : methods) {
    const DraftOrder order{info.method, default_shape(info.method), .35};
    const auto made = value_of(make_with_draft(model, order, {.8}));
    const auto [low, high] = std::ranges::minmax(made.heights);
    EXPECT_NEAR(std::max(high, 0.0) - std::min(low, 0.0), .35, 1e-12) << info.name;
    EXPECT_EQ(made.height, .35);
    EXPECT_LE(steepest(slopes_of(model, made.heights)), .8) << info.name;
    for (std::size_t i = 0; i < made.heights.size(); ++i) {
      if (model.surface().boundary.is_boundary[i]) ASSERT_EQ(made.heights[i], 0);
    }
  }
}

// Returns the largest height that an error message states, in mm.
double largest_named(const Result<Relief>& refused) {
  const std::string text = message_of(refused);
  const std::size_t at = text.find("at most ");
  EXPECT_NE(at, std::string::npos) << text;
  return std::stod(text.substr(at + 8));
}

TEST(Draft, AHeightOutOfReachTellsTheLargest) {
  const ReliefModel model = prepared(figure(6000));
  const Shape shape = default_shape(Method::layered);
  for (const double height : {1.2, 50.0}) {  // without the limit, 1.2 is reachable but 50 is not
    const auto made = make_with_draft(model, {Method::layered, shape, height, 10}, {.4});
    expect_error(made, ErrorKind::geometry);
    const double largest = largest_named(made) / 10;
    EXPECT_LT(largest, height);
    EXPECT_TRUE(make_with_draft(model, {Method::layered, shape, .99 * largest}, {.4}));
  }
}

// The error message states the largest height. This height must be reachable, whatever height was requested.
TEST(Draft, TheLargestHeightOfEveryMethodCanBeReached) {
  const ReliefModel model = prepared(figure(3000));
  for (const MethodInfo& info : methods)
    for (const double asked : {5.0, 500.0}) {
      const auto make = [&](double height) {
        return make_with_draft(model, {info.method, default_shape(info.method), height, 1}, {.4});
      };
      const double largest = largest_named(make(asked));
      EXPECT_GT(largest, .05) << info.name;
      for (const double share : {.999, .9, .5})
        EXPECT_TRUE(make(share * largest)) << info.name << " " << share << " of " << largest;
    }
}

TEST(Draft, HoldsOnABaseToo) {
  const ReliefModel model = prepared(figure(6000));
  std::vector<double> base;
  for (const Vec3& p : model.surface().points) base.push_back(.3 * p.x() + .1 * p.y() * p.y());
  const DraftOptions options{1.2, base};
  const auto made =
      value_of(make_with_draft(model, {Method::layered, default_shape(Method::layered), .45}, options));
  EXPECT_EQ(made.height, .45);
  std::vector<double> whole = made.heights;
  for (std::size_t i = 0; i < whole.size(); ++i) whole[i] += base[i];
  EXPECT_LE(steepest(slopes_of(model, whole)), 1.2);
  expect_error(make_with_draft(model, {Method::layered, default_shape(Method::layered), .5}, {.2, base}),
               "base");
}

TEST(Draft, HoldsForModelsOfControlPoints) {
  const ReliefModel model = prepared(figure(12000), Mode::subspace);
  const auto made =
      value_of(make_with_draft(model, {Method::layered, default_shape(Method::layered), .35}, {.7}));
  EXPECT_LE(steepest(slopes_of(model, made.heights)), .7);
  EXPECT_EQ(made.height, .35);
}

TEST(Draft, IsTheSameForAnyNumberOfThreads) {
  const ReliefModel model = prepared(figure());
  const DraftOrder order{Method::layered, default_shape(Method::layered), .4};
  test::expect_same_for_any_threads([&] { return value_of(make_with_draft(model, order, {.8})).heights; });
}

TEST(Draft, ScalesWithTheCloud) {
  Cloud cloud = figure(6000);
  const auto small =
      make_with_draft(prepared(cloud), {Method::layered, default_shape(Method::layered), .35}, {.8});
  for (Vec3& p : cloud.points) p *= 1024;
  const auto large =
      make_with_draft(prepared(cloud), {Method::layered, default_shape(Method::layered), .35 * 1024}, {.8});
  ASSERT_TRUE(small && large);
  for (std::size_t i = 0; i < small->heights.size(); ++i)
    ASSERT_NEAR(large->heights[i] / 1024, small->heights[i], 1e-4);
}

TEST(Draft, CanBeCancelled) {
  const ReliefModel model = prepared(figure(3000));
  Cancelled progress;
  EXPECT_EQ(limit_draft(model, model.make(default_shape(Method::paper)), {.1}, &progress).error().kind,
            ErrorKind::cancelled);
}

// Measures the draft angle in written files, because later steps may change a front.
TEST(Draft, IsKeptInFiles) {
  const ReliefModel model = prepared(figure());
  ReliefOptions options{{.height_mm = 8}};
  for (const Form form : {Form::relief, Form::mirror, Form::die})
    for (const Outline outline : {Outline::rectangle, Outline::circle, Outline::none})
      for (const bool is_simple : {false, true}) {
        options.draft_deg = is_simple ? 50 : 35;
        options.form = form;
        options.outline = outline;
        options.tolerance_mm = is_simple ? std::optional(.05) : std::nullopt;
        const auto made = value_of(make_relief(model, options));
        ASSERT_EQ(check_solid(made.solid), "");
        const double found = steepest_deg_in_stl(write_stl(made.solid), made.solid.front_triangles);
        EXPECT_LE(found, 90 - *options.draft_deg + 1e-9)
            << name_in(form_choices, form) << " " << name_in(outline_choices, outline) << " " << is_simple;
        EXPECT_NEAR(made.report.steepest_deg, found, 1e-9);
        EXPECT_NEAR(made.report.height_mm, 8, 1e-12);
        if (is_simple) EXPECT_LE(*made.report.simplification_error_mm, .05);
      }
}

TEST(Draft, RimsLeanAsMuch) {
  const ReliefModel model = prepared(figure(6000));
  ReliefOptions options{{.height_mm = 4, .draft_deg = 40, .rim_mm = 5}};
  for (const Outline outline : {Outline::rectangle, Outline::round, Outline::circle, Outline::hexagon})
    for (const Form form : {Form::relief, Form::die}) {
      options.outline = outline;
      options.form = form;
      const auto made = value_of(make_relief(model, options));
      EXPECT_EQ(check_solid(made.solid), "");
      const double found = steepest_deg_in_stl(write_stl(made.solid), made.solid.front_triangles);
      EXPECT_LE(found, 50) << name_in(outline_choices, outline) << " " << name_in(form_choices, form);
    }
  options.rim_bevel_mm = 1;
  EXPECT_EQ(make_relief(model, options).error().input, "rim-bevel");
  options.rim_bevel_mm = {};
  options.rim_mm = 2;
  options.rim_height_mm = 4;
  EXPECT_EQ(make_relief(model, options).error().input, "rim");
}

TEST(Draft, WithoutAHeightTooAndNotForLithophanes) {
  ReliefOptions options{{.alpha = .5, .draft_deg = 60}};
  EXPECT_LE(value_of(make_relief(figure(6000), options)).report.steepest_deg, 30);
  options.form = Form::lithophane;
  EXPECT_TRUE(make_relief(figure(6000), options).error().message().contains("draft"));
}

TEST(SteepestSlope, OfARampAndOfAWall) {
  HeightFieldMesh ramp = test::flat_front({10, 10, 2, 2});
  ramp.points[4].z() = 5;  // a rise of 5 mm over 5 mm
  Solid solid = make_plate(ramp, {}).value();
  EXPECT_NEAR(steepest_slope(solid), std::sqrt(2), 1e-6);
  solid.points[4].x() = solid.points[1].x();
  solid.points[4].y() = solid.points[1].y();
  EXPECT_TRUE(std::isinf(steepest_slope(solid)));
}

// The points are so dense, and so far from the origin, that rounding to single precision makes thin triangles steeper.
TEST(HoldDraft, TakesWhatRoundingAdds) {
  ASSERT_TRUE(rc::check([] {
    test::Random random(*rc::gen::arbitrary<std::uint64_t>());
    Cloud cloud = test::sheet(400, .03, 0, random.bits());
    const ReliefModel model = prepared(cloud);
    Relief steep = relief_of(model, [&](double, double) { return random.uniform(0, .01); });
    const Relief limited = limit_draft(model, steep, {1}).value();
    HeightFieldMesh front{{}, model.surface().triangulation.triangles, model.surface().triangulation.hull};
    for (std::size_t i = 0; i < limited.heights.size(); ++i)
      front.points.emplace_back(model.surface().points[i].x(), model.surface().points[i].y(),
                                limited.heights[i]);
    Solid solid = make_plate(front, {20, 3}).value();
    const Box before = [&] { return Box::of(solid.points); }();
    const auto moved = enforce_draft_in_float(solid, 1);
    RC_ASSERT(moved.has_value());
    RC_ASSERT(*moved < .001);
    RC_ASSERT(steepest_deg_in_stl(write_stl(solid), solid.front_triangles) <= 45);
    const Box after = Box::of(solid.points);
    RC_ASSERT(after.min == before.min && after.max == before.max);
    RC_ASSERT(check_solid(solid).empty());
  }));
}

TEST(HoldDraft, RefusesAFrontThatIsTooSteep) {
  HeightFieldMesh peak = test::flat_front({10, 10, 2, 2});
  peak.points[4].z() = 50;
  Solid solid = make_plate(peak, {}).value();
  const std::vector<Vec3> before = solid.points;
  EXPECT_EQ(enforce_draft_in_float(solid, 1).error().kind, ErrorKind::geometry);
  EXPECT_EQ(solid.points, before);
}

TEST(HoldDraft, RefusesWhatRoundingDoesBetweenPointsThatStay) {
  Solid solid;  // all points are above walls, so they must not move
  solid.points = {{20.0011017003, 20.0058829037, 3.00011886031},
                  {20.0012021058, 20.0057975004, 3},
                  {20.0012861059, 20.0059675612, 3.00011886031}};
  solid.triangles = {{0, 1, 2}, {0, 2, 1}};
  solid.front_triangles = 1;
  ASSERT_LT(slope_of(solid.points[0], solid.points[1], solid.points[2]).slope.norm(), .995);
  ASSERT_GT(steepest_slope(solid), 1);
  expect_error(enforce_draft_in_float(solid, 1), ErrorKind::geometry, "single precision");
}

}  // namespace
}  // namespace relievo
