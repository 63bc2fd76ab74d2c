#include "paper/height_to_order.h"

#include <gtest/gtest.h>

namespace relievo::paper {
namespace {

// Returns the height of a relief in which |k| = delta at all points. Without compression its height is 1.
double height_of(double alpha, double beta) {
  return 1 - std::exp(-std::pow(alpha, -beta));
}

TEST(PaperHeightToOrder, IsMetToOnePercent) {
  for (const double wanted : {.02, .1, .3, .6, .64, .9, .99}) {
    int calls = 0;
    double last = 0;
    const HeightToOrder found = adjust_to_height(wanted, [&](double alpha, double beta) {
      ++calls;
      return last = height_of(alpha, beta);
    });
    EXPECT_TRUE(found.is_met) << wanted;
    EXPECT_NEAR(height_of(found.alpha, found.beta), wanted, .01 * wanted);
    EXPECT_EQ(last, found.height);
    EXPECT_LT(calls, 80);
  }
}

// The beta that the search finds is the smallest: with half of it, no alpha from 0.001 to the
// largest double gives the height.
TEST(PaperHeightToOrder, HasTheSmallestBeta) {
  for (const double wanted : {.02, .3, .9}) {
    const double beta = adjust_to_height(wanted, height_of).beta;
    EXPECT_GT(beta, 1e-5);
    for (int i = 0; i <= 1033; ++i)
      EXPECT_GT(std::abs(height_of(std::ldexp(.001, i), beta / 2) - wanted), .01 * wanted);
  }
}

TEST(PaperHeightToOrder, IsNotMetIfItIsTooHigh) {
  EXPECT_FALSE(adjust_to_height(1.1, height_of).is_met);
  EXPECT_FALSE(adjust_to_height(1, [](double, double) { return 0.0; }).is_met);
}

}  // namespace
}  // namespace relievo::paper
