#include "relievo/relief/tone_curve.h"

#include <rapidcheck.h>

#include <algorithm>

#include "relief/weight_table.h"
#include "relievo/relief/weights.h"
#include "support/results.h"

namespace relievo {
namespace {

std::shared_ptr<const ToneCurve> curve(std::string_view text) {
  return std::make_shared<const ToneCurve>(*parse_tone_curve(text));
}

TEST(ToneCurve, PassesThroughItsPointsAndIsLevelOutside) {
  const ToneCurve c = *parse_tone_curve("0.25,0.125;0.5,0.5;0.75,0.25");
  EXPECT_DOUBLE_EQ(c(.25 * .25), .125);
  EXPECT_DOUBLE_EQ(c(.5 * .5), .5);
  EXPECT_DOUBLE_EQ(c(-.75 * .75), .25);
  EXPECT_EQ(c(0), .125);
  EXPECT_EQ(c(1), .25);
}

TEST(ToneCurve, OfPointsOnALineIsTheLine) {
  const ToneCurve c = *parse_tone_curve("0,0;0.3,0.3;0.6,0.6;1,1");
  for (double x = 0; x <= 1; x += .01) EXPECT_NEAR(c(x * x), x, 1e-12);
}

TEST(ToneCurve, OnePointIsEven) {
  const ToneCurve c = *parse_tone_curve("0.5,0.25");
  for (const double k : {0.0, .1, .25, 1.0}) EXPECT_EQ(c(k), .25);
}

TEST(ToneCurve, StaysBetweenNeighbouringPoints) {
  ASSERT_TRUE(rc::check([] {
    std::vector<Vec2> points;
    for (int i = 0; i < 6; ++i) points.emplace_back(i / 5.0, *rc::gen::inRange(0, 101) / 100.0);
    const ToneCurve c = *ToneCurve::through(points);
    for (int i = 0; i < 500; ++i) {
      const double x = i / 500.0;
      const auto& p = points[static_cast<std::size_t>(i / 100)];
      const auto& q = points[static_cast<std::size_t>(i / 100) + 1];
      const double y = c(x * x);
      RC_ASSERT(y >= std::min(p.y(), q.y()) - 1e-12 && y <= std::max(p.y(), q.y()) + 1e-12);
    }
  }));
}

TEST(ToneCurve, WrongTextsAreNamed) {
  for (const char* text :
       {"1", "a,b", "0;0", "0,0,0", "0,1.5", "-1,0", "0,nan", "0.5,0;0.5,1", "1,0;0,1", ""})
    expect_error(parse_tone_curve(text), "tone: expected");
  std::string many;
  for (int i = 0; i < 17; ++i) many += cat(i > 0 ? ";" : "", i / 20.0, ",0");
  expect_error(parse_tone_curve(many), "1 to 16 points");
}

// A tone curve through the values of equation (6) at u = 1 must give equation (6) at every u. So the
// paper's weight is one of the possible curves.
TEST(ToneCurve, HoldsThePapersFormula) {
  const double delta = .25, beta = .5, share = curvature_weight(.36, delta, {1, beta});
  const auto through = std::make_shared<const ToneCurve>(*ToneCurve::through({{.6, share}}));
  for (const double u : {.01, .3, 1.0, 4.0})
    EXPECT_NEAR(curvature_weight(.36, delta, {u, beta, through}), curvature_weight(.36, delta, {u, beta}),
                1e-12);
}

TEST(ToneCurve, WeightIsTheCurveAtUOneAndGrowsWithU) {
  const auto c = curve("0,0;0.5,0.2;1,1");
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_NEAR(curvature_weight(.25, .3, {1, 0, c}), .2, 1e-12);
  for (const double k : {0.0, .01, .3, 1.0}) {
    double last = 0;
    for (const double u : {0.0, 1e-3, .1, 1.0, 10.0, infinity}) {
      const double w = curvature_weight(k, .3, {u, 0, c});
      EXPECT_TRUE(w >= last && w <= 1) << k << " " << u;
      last = w;
    }
    EXPECT_EQ(curvature_weight(k, .3, {0, 0, c}), 0);
    EXPECT_EQ(last, k > 0 ? 1 : 0);
  }
}

TEST(ToneCurve, TheTableFollowsIt) {
  const Compression compression{.7, 0, curve("0,0.1;0.2,0.6;0.5,0.2;1,0.9")};
  WeightTable table;
  table.fill(.3, compression);
  for (double k = 1e-4; k <= 1; k *= 1.01)
    ASSERT_NEAR(static_cast<double>(table(static_cast<float>(k))), curvature_weight(k, .3, compression), 1e-4)
        << k;
}

}  // namespace
}  // namespace relievo
