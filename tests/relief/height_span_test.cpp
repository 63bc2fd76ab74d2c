#include "relievo/detail.h"

#include <gtest/gtest.h>

#include <vector>

namespace relievo {
namespace {

TEST(HeightSpan, IncludesTheBase) {
  EXPECT_EQ(height_span(std::vector<double>{}), 0);
  EXPECT_EQ(height_span(std::vector<double>{1, 3}), 3);
  EXPECT_EQ(height_span(std::vector<double>{-2, -1}), 2);
  EXPECT_EQ(height_span(std::vector<double>{-2, 5}), 7);
}

TEST(Detail, IsGammaTimesCurvatureTimesHeight) {
  std::vector<double> z{0, 4, 10};
  const std::vector<float> k{1, -.5F, .25F}, w{0, 1, 1};
  add_detail(z, {k, w, .1});
  EXPECT_EQ(z[0], 0);  // the boundary stays on the base
  EXPECT_DOUBLE_EQ(z[1], 4 - .1 * .5 * 10);
  EXPECT_DOUBLE_EQ(z[2], 10 + .1 * .25 * 10);
}

}  // namespace
}  // namespace relievo
