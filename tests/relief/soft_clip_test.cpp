#include "relief/correction/soft_clip.h"

#include <gtest/gtest.h>

#include <vector>

namespace relievo {
namespace {

constexpr double share = SoftClip<double>::clipped_share, kept = (1 + SoftClip<double>::least_slope) / 2;

TEST(SoftClip, KeepsTheMiddleAndRoundsTheEnds) {
  std::vector<double> heights;
  for (int i = 0; i <= 100000; ++i) heights.push_back(i * 1e-5 - .3);
  const SoftClip<double> clip{heights};
  double last = clip(-.3);
  for (double z = -.295; z < .695; z += .01) EXPECT_EQ(clip(z), z);
  for (const double z : heights) {
    EXPECT_GE(clip(z), last);
    last = clip(z);
  }
  // Beyond a limit, the slope of the clip decreases from 1 to the smallest slope. The mean of these slopes is `kept`.
  EXPECT_NEAR(clip(.7), .7 - (1 - kept) * share, 1e-4);
  EXPECT_NEAR(clip(-.3), -.3 + (1 - kept) * share, 1e-4);
  EXPECT_NEAR(clip.span(), 1 - 2 * (1 - kept) * share, 1e-4);
}

TEST(SoftClip, TakesTheHeightOfAFewPoints) {
  std::vector<float> heights(10000, .5F);
  heights[7] = 10;
  const SoftClip<float> clip{heights};
  EXPECT_EQ(clip(.4F), .4F);
  EXPECT_LT(clip(10), 6.5F);
  EXPECT_EQ(clip.span(), clip(10));
}

TEST(SoftClip, LeavesTheBaseWhereItIs) {
  for (const std::vector<double>& heights : {std::vector<double>{}, {0, 0}, {1, 2, 3}, {-3, -2}}) {
    const SoftClip<double> clip{heights};
    EXPECT_EQ(clip(0), 0);
  }
}

}  // namespace
}  // namespace relievo
