#include "paper/compression.h"

#include <gtest/gtest.h>

namespace relievo::paper {
namespace {

// Computes equation (6) as printed in the paper, with alpha.
double printed_weight(double k, double delta, double alpha, double beta) {
  return 1 - std::exp(-std::pow(std::abs(k) / (alpha * delta), beta));
}

TEST(PaperCompression, WeightIsEquation6) {
  for (const double alpha : {.5, 4.0, 1e9})
    for (const double beta : {.01, 1.0, 5.0})
      for (const double k : {-.9, -.1, .3, 1.0})
        EXPECT_NEAR(curvature_weight(k, .2, {std::pow(alpha, -beta), beta}),
                    printed_weight(k, .2, alpha, beta), 1e-12);
}

TEST(PaperCompression, WeightHasTheLimitsThatThePaperNames) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(curvature_weight(0, .2, {infinity, 1}), 1);                      // alpha = 0 does not compress
  EXPECT_NEAR(curvature_weight(.7, .2, {1, 0}), 1 - std::exp(-1.0), 1e-15);  // beta = 0 compresses all alike
  EXPECT_EQ(curvature_weight(0, .2, {1, 1}), 0);
  EXPECT_EQ(curvature_weight(0, 0, {1, 1}), curvature_weight(1, 0, {1, 1}));  // no point has curvature
}

TEST(PaperCompression, BoundaryWeightIsEquation7) {
  EXPECT_EQ(boundary_weight(0, 2), 0);
  EXPECT_NEAR(boundary_weight(2, 2), 1 - std::exp(-1.0), 1e-15);
}

// The slope is perpendicular to the compressed normal n~, see equation (5): n~ . (1, 0, dz/dx) = 0, and likewise for y.
TEST(PaperCompression, SlopeIsThatOfEquation5) {
  const Vec3 normal = Vec3(.3, -.5, .6).normalized();
  for (const double w : {0.0, .4, 1.0}) {
    const Vec3 expected = w * normal + (1 - w) * Vec3::UnitZ();
    const Vec2 slope = slope_of(expected_normal(normal, w), 4);
    EXPECT_NEAR(expected.dot(Vec3(1, 0, slope.x())), 0, 1e-15);
    EXPECT_NEAR(expected.dot(Vec3(0, 1, slope.y())), 0, 1e-15);
  }
}

TEST(PaperCompression, SlopeHasALimit) {
  EXPECT_LT((slope_of(Vec3(1, 0, 0), 4) - Vec2(-4, 0)).norm(), 1e-15);
  EXPECT_LT((slope_of(Vec3(0, .8, -.6), 4) - Vec2(0, -4)).norm(), 1e-15);
}

}  // namespace
}  // namespace relievo::paper
