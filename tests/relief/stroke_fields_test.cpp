#include "relief/stroke_fields.h"

#include "core/height_span.h"
#include "relievo/relief/weights.h"
#include "support/strokes.h"

namespace relievo {
namespace {

using test::applied, test::dab, test::painted, test::place_of, test::surface_of, test::waves;

double profile(double distance, double radius) {
  const double x = distance / radius;
  return x < 1 ? (1 - x * x) * (1 - x * x) : 0;
}

TEST(StrokeMask, FadesWithTheDistanceFromTheLine) {
  const Surface surface = surface_of(test::sheet(20000, 1, 0));
  Stroke stroke = dab(Brush::raise, {-.4, .1, 0}, .25);
  stroke.points.emplace_back(.4, .1, 0);
  const std::vector<float> weights = test::weights_of(surface, stroke);
  for (Index i = 0; i < weights.size(); ++i) {
    const Vec3 p = place_of(surface, i);
    const double beyond = std::max(0.0, std::abs(p.x()) - .4);
    EXPECT_NEAR(weights[i], profile(std::hypot(beyond, p.y() - .1), .25), 1e-6) << p.transpose();
  }
}

TEST(StrokeMask, IsThatOfTheNearestOfManyCorners) {
  const Surface surface = surface_of(test::sheet(20000, 1, 0));
  Stroke stroke{.brush = Brush::raise, .radius = .07};
  for (int i = 0; i < 45; ++i) stroke.points.emplace_back(-.8 + .035 * i, .6 * std::sin(.9 * i), 0);
  const std::vector<float> weights = test::weights_of(surface, stroke);
  const auto nearest = [&](const Vec3& p) {  // distance from the line, which is sampled every 1/500
    double least = 9;
    for (std::size_t i = 1; i < stroke.points.size(); ++i)
      for (int t = 0; t <= 300; ++t)
        least = std::min(
            least, (p - stroke.points[i - 1] - (stroke.points[i] - stroke.points[i - 1]) * t / 300).norm());
    return least;
  };
  for (Index i = 0; i < weights.size(); i += 37)
    EXPECT_NEAR(weights[i], profile(nearest(place_of(surface, i)), .07), .003);
}

TEST(StrokeMask, IsFullInsideAHardStroke) {
  const Surface surface = surface_of(test::sheet(20000, 1, 0));
  Stroke stroke = dab(Brush::raise, {0, 0, 0}, .4);
  stroke.softness = .25;
  const StrokeMask mask = stroke_mask(surface, stroke);
  for (std::size_t k = 0; k < mask.points.size(); ++k)
    if (place_of(surface, mask.points[k]).norm() < .29) EXPECT_FLOAT_EQ(mask.weights[k], 1);
  EXPECT_GT(mask.points.size(), 20000 * std::numbers::pi * .16 / 4 * .95);
}

TEST(StrokeMask, BelongsToTheModelInEveryView) {
  const Cloud ball = test::sphere(40000, 1);
  const Vec3 at = Vec3(.2, .3, .93).normalized();
  for (const Vec2& turn_deg : {Vec2(0, 0), Vec2(20, 0), Vec2(-25, 10), Vec2(15, -20), Vec2(0, 30)}) {
    const Mat3 turn = (Eigen::AngleAxisd(turn_deg.x() / 57.3, Vec3::UnitY()) *
                       Eigen::AngleAxisd(turn_deg.y() / 57.3, Vec3::UnitX()))
                          .toRotationMatrix();
    View view{.R_view_model = turn};
    const Surface surface = surface_of(ball, view);
    const StrokeMask mask = stroke_mask(surface, dab(Brush::raise, at));
    ASSERT_GT(mask.points.size(), 400U);
    for (std::size_t k = 0; k < mask.points.size(); ++k)
      EXPECT_NEAR(mask.weights[k], profile((place_of(surface, mask.points[k]) - at).norm(), .3), .01);
  }
}

TEST(StrokeMask, IsEmptyWhereTheViewShowsNothingOfTheLine) {
  const Surface front = surface_of(test::sphere(20000, 1));
  EXPECT_TRUE(stroke_mask(front, dab(Brush::raise, {0, 0, -1})).points.empty());
  EXPECT_TRUE(stroke_mask(front, Stroke{.radius = 1}).points.empty());
}

TEST(StrokeMask, DoesNotReachAcrossADepthJump) {
  // The right half of the square lies 0.25 behind the left half. Points of both halves are within the radius
  // of 0.5, but the stroke must stay on the nearer half.
  const Surface surface = test::step(.25);
  const StrokeMask mask = stroke_mask(surface, dab(Brush::raise, {-.1, 0, .25}, .5));
  ASSERT_GT(mask.points.size(), 1000U);
  for (const Index i : mask.points) EXPECT_LT(place_of(surface, i).x(), .02);
}

TEST(StrokeFields, RaiseAndSinkByAShareOfTheHeight) {
  const Surface surface = surface_of(test::sheet(20000, 1, 0));
  const std::vector<double> z(surface.points.size(), .5);
  const auto changed = applied(
      surface, {dab(Brush::raise, {.3, .3, 0}, .2, .1), dab(Brush::sink, {-.4, -.4, 0}, .3, .05)}, z, 2);
  for (Index i = 0; i < z.size(); ++i) {
    const Vec3 p = place_of(surface, i);
    EXPECT_NEAR(changed[i],
                .5 + .2 * profile((p - Vec3(.3, .3, 0)).norm(), .2) -
                    .1 * profile((p - Vec3(-.4, -.4, 0)).norm(), .3),
                1e-6);
  }
}

TEST(StrokeFields, KeepEveryHeightOutside) {
  const Surface surface = surface_of(test::sphere(30000, 1));
  std::vector<double> z;
  for (const Vec3& p : surface.points) z.push_back(.1 * (p.z() + 1) + .01 * std::sin(30 * p.x()));
  const Vec3 at(.2, .1, std::sqrt(1 - .05));
  for (const auto& [word, brush] : brushes) {
    if (brush == Brush::in_front) continue;  // this brush needs a depth jump; another test covers it
    const auto changed = applied(surface, {dab(brush, at)}, z, .2, std::vector<double>(z.size(), .05));
    double most = 0;
    for (Index i = 0; i < z.size(); ++i) {
      const bool is_inside = (place_of(surface, i) - at).norm() < .3;
      EXPECT_TRUE(is_inside || changed[i] == z[i]) << word;
      most = std::max(most, std::abs(changed[i] - z[i]));
    }
    EXPECT_GT(most, 1e-4) << word;
  }
}

TEST(StrokeFields, LevelToTheMean) {
  const Surface surface = surface_of(test::sheet(20000, 1, 0));
  std::vector<double> z;
  for (const Vec3& p : surface.points) z.push_back(1 + .3 * p.x());
  Stroke stroke = dab(Brush::level, {.2, 0, 0}, .4);
  stroke.softness = .05;
  const auto changed = applied(surface, {stroke}, z);
  for (Index i = 0; i < z.size(); ++i) {
    const double distance = (place_of(surface, i) - Vec3(.2, 0, 0)).norm();
    if (distance < .37) EXPECT_NEAR(changed[i], 1.06, .002);
  }
}

// Two blurs with half of the variance each multiply a wave with wave number k by 1 / (1 + sigma^2 k^2 / 4)^2.
TEST(StrokeFields, BlurWavesAsTheirTransferFunctionSays) {
  const Surface surface = surface_of(test::sheet(80000, 1, 0));
  for (const auto& [brush, sigma, sign] :
       {std::tuple(Brush::soften, 2 * narrow_blur, -1), std::tuple(Brush::sharpen, 2 * narrow_blur, 1),
        std::tuple(Brush::strengthen, 2 * wide_blur, 1)}) {
    const double k = 1 / sigma;
    std::vector<double> z;
    for (const Vec3& p : surface.points) z.push_back(1 + .1 * std::sin(k * p.x()));
    Stroke stroke = dab(brush, {0, 0, 0}, .8);
    stroke.softness = .3;
    const auto changed = applied(surface, {stroke}, z);
    const double removed = 1 - 1 / std::pow(1 + sigma * sigma * k * k / 4, 2);
    double product = 0, square_sum = 0;
    for (Index i = 0; i < z.size(); ++i) {
      if (surface.points[i].norm() > .4) continue;
      product += (changed[i] - 1) * (z[i] - 1);
      square_sum += (z[i] - 1) * (z[i] - 1);
    }
    EXPECT_NEAR(product / square_sum, 1 + sign * removed, .06 * removed);
  }
}

TEST(StrokeFields, ChangeNothingWhenMuted) {
  const Surface surface = surface_of(test::sheet(20000, 1, 0));
  const std::vector<double> z(surface.points.size(), .5);
  Stroke stroke = dab(Brush::raise, {0, 0, 0});
  stroke.is_muted = true;
  EXPECT_EQ(applied(surface, {stroke}, z), z);
  EXPECT_EQ(applied(surface, {}, z), z);
}

TEST(StrokeFields, AreThoseOfTheLastStrokesAlone) {
  const Surface surface = surface_of(test::sheet(20000, 1, 0));
  const Strokes first{dab(Brush::raise, {0, 0, 0}), dab(Brush::soften, {.5, 0, 0})},
      last{dab(Brush::raise, {0, 0, 0}), dab(Brush::level, {-.5, 0, 0})};
  std::vector<double> z;
  for (const Vec3& p : surface.points) z.push_back(1 + .1 * std::sin(20 * p.x()));
  StrokeFields<double> fields(surface);
  std::vector<double> twice = z;
  fields.take(first);
  fields.apply(1, {}, std::span<double>(twice));
  twice = z;
  fields.take(last);
  fields.apply(1, {}, std::span<double>(twice));
  EXPECT_EQ(twice, applied(surface, last, z));
}

TEST(StrokeFields, AreTheSumOfStrokesThatDoNotTouch) {
  const Surface surface = surface_of(test::sheet(20000, 1, 0));
  const std::vector<double> z = waves(surface);
  std::vector<double> sum = z;
  Strokes all;
  for (std::size_t i = 0; i < brushes.size(); ++i) {
    const double turn = 2 * std::numbers::pi * static_cast<double>(i) / brushes.size();
    all.push_back(dab(brushes[i].value, {.6 * std::cos(turn), .6 * std::sin(turn), 0}, .2, .5));
    const auto alone = applied(surface, {all.back()}, z);
    for (std::size_t k = 0; k < z.size(); ++k) sum[k] += alone[k] - z[k];
  }
  const auto together = applied(surface, all, z);
  for (std::size_t k = 0; k < z.size(); ++k) EXPECT_NEAR(together[k], sum[k], 1e-12);
}

TEST(StrokeFields, SubtractNoMoreThanThereIsWhereTheyOverlap) {
  const Surface surface = surface_of(test::sheet(20000, 1, 0));
  const std::vector<double> z = waves(surface);
  Stroke soft = dab(Brush::soften, {0, 0, 0}, .5);
  soft.softness = .05;
  const auto once = applied(surface, {soft}, z), thrice = applied(surface, {soft, soft, soft}, z);
  for (Index i = 0; i < z.size(); ++i)
    if (surface.points[i].head<2>().norm() < .47) EXPECT_NEAR(thrice[i], once[i], 1e-12);
}

// A stroke grows step by step, beside strokes that do not change. The effect must always be the same as if
// all strokes were new.
TEST(StrokeFields, KeepWhatDidNotChangeOnlyForTheSameHeights) {
  const Surface surface = surface_of(test::sheet(20000, 1, 0));
  StrokeFields<double> fields(surface);
  Strokes strokes{dab(Brush::soften, {-.5, 0, 0}), dab(Brush::strengthen, {.5, 0, 0}),
                  dab(Brush::sharpen, {0, .5, 0})};
  std::vector<double> z = waves(surface);
  for (int step = 0; step < 4; ++step) {
    if (step == 2) strokes.erase(strokes.begin());
    if (step == 3)
      for (double& height : z) height = 2 - height;
    strokes.back().points.emplace_back(.1 * step, .4, 0);
    std::vector<double> live = z;
    fields.take(strokes);
    fields.apply(1, {}, std::span<double>(live));
    EXPECT_EQ(live, applied(surface, strokes, z)) << step;
  }
}

TEST(StrokeFields, NeverFallBelowTheBase) {
  const Surface surface = surface_of(test::sheet(20000, 1, 0));
  const auto changed =
      applied(surface, {dab(Brush::sink, {0, 0, 0})}, std::vector<double>(surface.points.size(), .2));
  EXPECT_GE(*std::ranges::min_element(changed), 0);
}

TEST(StrokeFields, AgreeInBothPrecisions) {
  const Surface surface = surface_of(test::sphere(20000, 1));
  std::vector<double> z;
  for (const Vec3& p : surface.points) z.push_back(.1 * (p.z() + 1) + .01 * std::sin(30 * p.x()));
  const Strokes strokes{dab(Brush::sharpen, {0, 0, 1}), dab(Brush::strengthen, {.3, 0, .95}),
                        dab(Brush::level, {-.3, 0, .95})};
  const auto exact = applied<double>(surface, strokes, z, .2);
  const auto quick = applied<float>(surface, strokes, {z.begin(), z.end()}, .2);
  for (std::size_t i = 0; i < z.size(); ++i) EXPECT_NEAR(quick[i], exact[i], 1e-6);
}

const Strokes beside_the_top{dab(Brush::sharpen, {-.2, .2, -1.117}, .2),
                             dab(Brush::sink, {-.5, .4, -.997}, .2, .2)};

TEST(StrokesOfReliefs, MoveNothingElseAndKeepTheHeight) {
  const ReliefModel model = test::prepared(test::bumps_behind_a_ring(10000));
  const Relief plain = value_of(model.make_at_height(.2, layered_shape(), 1)),
               changed = value_of(model.make_at_height(.2, painted(beside_the_top), 1));
  EXPECT_DOUBLE_EQ(changed.height, .2);
  EXPECT_EQ(height_span(changed.heights), .2);
  std::vector<std::uint8_t> is_painted(plain.heights.size(), 0);
  for (const Stroke& stroke : beside_the_top)
    for (const Index i : stroke_mask(model.surface(), stroke).points) is_painted[i] = 1;
  std::size_t moved = 0;
  for (std::size_t i = 0; i < plain.heights.size(); ++i) {
    if (!is_painted[i]) EXPECT_NEAR(changed.heights[i], plain.heights[i], 1e-12);
    moved += is_painted[i] && std::abs(changed.heights[i] - plain.heights[i]) > 1e-4;
  }
  EXPECT_GT(moved, 100U);
}

TEST(StrokesOfReliefs, KeepTheHeightOfARaisedTop) {
  const ReliefModel model = test::prepared(test::sphere(10000, 1));
  const Relief raised =
      value_of(model.make_at_height(.2, painted({dab(Brush::raise, {0, 0, 1}, .3, .5)}), 1));
  EXPECT_DOUBLE_EQ(raised.height, .2);
  EXPECT_EQ(height_span(raised.heights), .2);
}

TEST(StrokesOfReliefs, AreThoseOfFrames) {
  const ReliefModel model = test::prepared(test::bumps_behind_a_ring(10000));
  const Relief relief = model.make(painted(beside_the_top));
  FrameMaker frames(model);
  Frame frame;
  frames.make({painted(beside_the_top)}, frame);
  EXPECT_NEAR(frame.height, relief.height, 1e-4 * relief.height);
  for (std::size_t i = 0; i < relief.heights.size(); ++i)
    EXPECT_NEAR(frame.heights[i], relief.heights[i], 2e-3 * relief.height);
  // After the strokes are removed, the frame must be that of a model that never had strokes.
  frames.make({}, frame);
  EXPECT_EQ(frame.heights, test::frame_of(model, {}).heights);
}

}  // namespace
}  // namespace relievo
