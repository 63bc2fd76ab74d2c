#include "relief/membrane/soft_clip.h"

#include <gtest/gtest.h>

#include <vector>

namespace relievo {
namespace {

constexpr double share = HeightTails<double>::share, kept = (1 + HeightTails<double>::flattest) / 2;

TEST(HeightTails, KeepTheMiddleAndRoundTheEnds) {
  std::vector<double> heights;
  for (int i = 0; i <= 100000; ++i) heights.push_back(i * 1e-5 - .3);
  const HeightTails<double> tails{heights};
  double last = tails(-.3);
  for (double z = -.295; z < .695; z += .01) EXPECT_EQ(tails(z), z);
  for (const double z : heights) {
    EXPECT_GE(tails(z), last);
    last = tails(z);
  }
  // A tail of slope 1 to the flattest keeps their mean of its length.
  EXPECT_NEAR(tails(.7), .7 - (1 - kept) * share, 1e-4);
  EXPECT_NEAR(tails(-.3), -.3 + (1 - kept) * share, 1e-4);
  EXPECT_NEAR(tails.span(), 1 - 2 * (1 - kept) * share, 1e-4);
}

TEST(HeightTails, TakeTheHeightOfAFewPoints) {
  std::vector<float> heights(10000, .5F);
  heights[7] = 10;
  const HeightTails<float> tails{heights};
  EXPECT_EQ(tails(.4F), .4F);
  EXPECT_LT(tails(10), 6.5F);
  EXPECT_EQ(tails.span(), tails(10));
}

TEST(HeightTails, LeaveTheBaseWhereItIs) {
  for (const std::vector<double>& heights : {std::vector<double>{}, {0, 0}, {1, 2, 3}, {-3, -2}}) {
    const HeightTails<double> tails{heights};
    EXPECT_EQ(tails(0), 0);
  }
}

}  // namespace
}  // namespace relievo
