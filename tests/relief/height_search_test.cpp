#include "relief/height_search.h"

#include <gtest/gtest.h>

namespace relievo {
namespace {

// Returns the height 5 (1 - exp(-u)), and counts the calls. This function grows with u as the height of a relief does.
struct Growth {
  double last = 0;  // the height at the last call
  int calls = 0;

  double operator()(double log_u) {
    ++calls;
    return last = -5 * std::expm1(-std::exp(log_u));
  }
};

TEST(HeightSearch, BracketsAnyHeightThatCanBeReached) {
  for (const double height : {1e-6, .1, 2.0, 4.99}) {
    Growth growth;
    EXPECT_TRUE(HeightSearch(height, 1e-5).bracket(growth));
    EXPECT_NEAR(growth.last / height, 1, 1.1e-5);
  }
}

TEST(HeightSearch, EndsWithTheHighestWhereTheHeightIsOutOfReach) {
  Growth bracketed, tracked, climbed;
  EXPECT_FALSE(HeightSearch(5.1, 1e-5).bracket(bracketed));
  EXPECT_EQ(bracketed.last, 5);
  EXPECT_EQ(bracketed.calls, 1);
  HeightSearch::Track track;
  EXPECT_FALSE(HeightSearch(5.1, 1e-5).track(track, tracked));
  EXPECT_EQ(tracked.last, 5);
  EXPECT_EQ(track.log_u, 0);  // the next search must start from the last success
  EXPECT_FALSE(HeightSearch(5.1, .003).climb(0, 4.5, climbed));
  EXPECT_EQ(climbed.last, Growth()(4.5));
}

// If points have no curvature, they may get their slope only at u = infinity, where the height then jumps.
// A search for a height within this jump must end above the jump.
TEST(HeightSearch, EndsAboveAHeightThatHeightsLeapOver) {
  double last = 0;
  const auto leaping = [&](double log_u) {
    return last = std::isinf(log_u) ? 5 : -3 * std::expm1(-std::exp(log_u));
  };
  EXPECT_TRUE(HeightSearch(4, 1e-5).bracket(leaping));
  EXPECT_EQ(last, 5);
  HeightSearch::Track track;
  EXPECT_TRUE(HeightSearch(4, 1e-5).track(track, leaping));
  EXPECT_EQ(last, 5);
  EXPECT_TRUE(HeightSearch(2, 1e-5).bracket(leaping));
  EXPECT_NEAR(last, 2, 1e-4);
  EXPECT_FALSE(HeightSearch(6, 1e-5).bracket(leaping));
}

// If some slopes are not compressed, all heights may be above the requested one. The search must then end at
// the lowest height.
TEST(HeightSearch, EndsAboveAHeightThatIsBelowAll) {
  double last = 0;
  const auto high = [&](double x) { return last = 4.1 + 1 / (1 + std::exp(-x)); };
  EXPECT_TRUE(HeightSearch(4, 1e-5).bracket(high));
  EXPECT_NEAR(last, 4.1, 1e-6);
}

TEST(HeightSearch, TracksSmallChangesInTwoCalls) {
  HeightSearch::Track track;
  Growth first;
  EXPECT_TRUE(HeightSearch(2, 5e-4).track(track, first));
  for (double height = 2; height < 3; height *= 1.01) {
    Growth growth;
    EXPECT_TRUE(HeightSearch(height, 5e-4).track(track, growth));
    EXPECT_NEAR(growth.last / height, 1, 6e-4);
    EXPECT_LE(growth.calls, 2) << height;
  }
}

// Once the search knows how the height grows with u, a change within the tolerance must take only one call.
TEST(HeightSearch, TracksWithinATolerance) {
  HeightSearch::Track track;
  int calls = 0, heights = 0;
  for (double height = 2; height < 3; height *= 1.02, ++heights) {
    Growth growth;
    EXPECT_TRUE(HeightSearch(height, .03).track(track, growth));
    EXPECT_NEAR(growth.last / height, 1, .031);
    calls += growth.calls;
  }
  EXPECT_LE(calls, heights + 5);
}

TEST(HeightSearch, TracksAcrossFarJumps) {
  HeightSearch::Track track;
  for (const double height : {2.0, 1e-6, 4.9, .5}) {
    Growth growth;
    EXPECT_TRUE(HeightSearch(height, 5e-4).track(track, growth));
    EXPECT_NEAR(growth.last / height, 1, 6e-4);
    EXPECT_NEAR(growth(track.log_u) / height, 1, 6e-4);
  }
}

TEST(HeightSearch, ClimbsToWhatIsNotTooLow) {
  for (const double height : {.5, 2.0, 4.0, 4.9}) {
    const double below = std::log(-std::log1p(-.8 * height / 5));  // log u at 4/5 of the height
    Growth growth;
    EXPECT_TRUE(HeightSearch(height, .003).climb(below, 4.5, growth));
    EXPECT_GE(growth.last, height);
    EXPECT_LE(growth.last, 1.0061 * height);
    EXPECT_LE(growth.calls, 8) << height;
  }
}

// If making a relief failed, the caller ends the search by returning the requested height. There must be no
// further call.
TEST(HeightSearch, EndsEarlyWhenItIsGivenTheHeight) {
  for (const int failing : {1, 2, 3}) {
    int calls = 0;
    const auto height_at = [&](double log_u) { return ++calls < failing ? Growth()(log_u) : 1.0; };
    EXPECT_TRUE(HeightSearch(1, 1e-5).bracket(height_at));
    EXPECT_EQ(calls, failing);
    calls = 0;
    HeightSearch::Track track{-3, 1};
    EXPECT_TRUE(HeightSearch(1, 1e-5).track(track, height_at));
    EXPECT_EQ(calls, failing);
    calls = 0;
    EXPECT_TRUE(HeightSearch(1, .003).climb(-3, 4.5, height_at));
    EXPECT_EQ(calls, failing);
  }
}

}  // namespace
}  // namespace relievo
