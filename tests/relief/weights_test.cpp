#include "relievo/relief/weights.h"

#include <gtest/gtest.h>

#include <limits>
#include <memory>

#include "relievo/relief/tone_curve.h"

namespace relievo {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Computes equation (6) as printed in the paper.
double printed(double k, double delta, double alpha, double beta) {
  return 1 - std::exp(-std::pow(std::abs(k) / (alpha * delta), beta));
}

TEST(CurvatureWeight, IsEquationSix) {
  for (const double alpha : {.01, 1.0, 4.0, 300.0})
    for (const double beta : {.01, .5, 2.5, 10.0})
      for (const double k : {-1.0, -.3, .01, .25, 1.0})
        EXPECT_NEAR(curvature_weight(k, .25, Compression::from_alpha(alpha, beta)),
                    printed(k, .25, alpha, beta), 1e-12);
}

TEST(CurvatureWeight, KeepsEveryNormalAtAlphaZero) {
  for (const double beta : {0.0, .01, 5.0})
    EXPECT_EQ(curvature_weight(.2, .25, Compression::from_alpha(0, beta)), 1);
  EXPECT_EQ(curvature_weight(.2, .25, {infinity, 0}), 1);
}

TEST(CurvatureWeight, DoesNotDependOnCurvatureAtBetaZero) {
  for (const double u : {0.0, .3, 1.0, 7.0})
    for (const double k : {0.0, .001, -1.0})
      EXPECT_DOUBLE_EQ(curvature_weight(k, .25, {u, 0}), 1 - std::exp(-u));
}

TEST(CurvatureWeight, SurvivesExtremes) {
  for (const double alpha : {1e-300, 1e300})
    for (const double beta : {1e-5, 100.0})
      for (const double k : {0.0, 1e-300, 1.0})
        for (const double delta : {0.0, 1e-300, .25}) {
          const double w = curvature_weight(k, delta, Compression::from_alpha(alpha, beta));
          EXPECT_GE(w, 0);
          EXPECT_LE(w, 1);
        }
}

TEST(Compression, AlphaAndUSayTheSame) {
  for (const double alpha : {.1, 4.0, 1e4})
    for (const double beta : {.01, 1.0, 10.0}) {
      EXPECT_NEAR(Compression::from_alpha(alpha, beta).alpha() / alpha, 1, 1e-9);
      EXPECT_NEAR(Compression::from_alpha(alpha, beta).u / std::pow(alpha, -beta), 1, 1e-9);
    }
}

TEST(Compression, LeavesAlphaOpenAtBetaZero) {
  for (const double u : {0.0, .5, 1.0, 2.0, infinity}) EXPECT_TRUE(std::isnan((Compression{u, 0}.alpha())));
}

// For every u, the factor of the saturation must be equation (6) at u = 1, divided by its value at |k| = delta.
TEST(Saturation, IsEquationSixWithoutItsHeight) {
  for (const double u : {.2, 1.0, 6.0})
    for (const double beta : {0.0, .5, 2.0})
      for (const double k : {-.75, .01, .25, 1.0}) {
        const Compression compression{u, beta};
        const double factor =
            curvature_weight(k, .25, saturation_alone(compression)) * saturation_scale(compression);
        EXPECT_NEAR(factor, printed(k, .25, 1, beta) / (1 - std::exp(-1)), 1e-12) << u << ' ' << beta;
        if (beta == 0 || k == .25) EXPECT_NEAR(factor, 1, 1e-12);
      }
}

TEST(Saturation, IsTheToneCurveItself) {
  const auto curve = std::make_shared<const ToneCurve>(*ToneCurve::through({{0, .2}, {.5, .7}, {1, .9}}));
  for (const double u : {.2, 1.0, 6.0})
    for (const double k : {-.25, 0.0, .04, 1.0}) {
      const Compression compression{u, .5, curve};
      const double factor =
          curvature_weight(k, .25, saturation_alone(compression)) * saturation_scale(compression);
      EXPECT_NEAR(factor, (*curve)(k), 1e-12) << u << ' ' << k;
    }
}

TEST(BoundaryWeight, IsEquationSeven) {
  const double rho = .5;
  EXPECT_EQ(boundary_weight(0, rho), 0);
  EXPECT_DOUBLE_EQ(boundary_weight(2 * rho, rho), 1 - std::exp(-1));
  EXPECT_DOUBLE_EQ(boundary_weight(4 * rho, rho), 1 - std::exp(-4));
  EXPECT_EQ(boundary_weight(infinity, rho), 1);
}

// The vector n~ of equation (5) is normal to the compressed surface. With weight 0 that surface is level;
// with weight 1 it is the original surface.
TEST(CompressedSlope, IsEquationFive) {
  const Vec3 normal = Vec3(.6, -.5, .4).normalized();
  for (const double w : {0., .1, .5, .9, 1.}) {
    const Vec3 n = w * normal + (1 - w) * Vec3::UnitZ();
    const Vec2 s = compressed_slope(normal, w, 100);
    EXPECT_NEAR(n.dot(Vec3(1, 0, s.x())), 0, 1e-12);
    EXPECT_NEAR(n.dot(Vec3(0, 1, s.y())), 0, 1e-12);
  }
}

TEST(CompressedSlope, IsNeverSteeperThanAllowed) {
  const Vec2 edge_on = compressed_slope(Vec3(-1, 0, 0), 1.0, 4);
  EXPECT_NEAR(edge_on.x(), 4, 1e-12);
  EXPECT_EQ(edge_on.y(), 0);
  EXPECT_NEAR(compressed_slope(Vec3(.8, .59, .1).normalized(), 1.0, 2.5).norm(), 2.5, 1e-12);
}

}  // namespace
}  // namespace relievo
