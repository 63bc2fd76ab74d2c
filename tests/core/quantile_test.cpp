#include "core/quantile.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/angle.h"
#include "core/random.h"

namespace relievo {
namespace {

TEST(Quantile, IsTheValueOfItsRank) {
  SplitMix64 random(3);
  for (const std::size_t n : {1U, 2U, 7U, 100U}) {
    std::vector<double> values(n);
    for (double& v : values) v = random.uniform();
    std::vector<double> sorted = values;
    std::ranges::sort(sorted);
    EXPECT_EQ(quantile(values, 0), sorted.front());
    EXPECT_EQ(quantile(values, 1), sorted.back());
    EXPECT_EQ(quantile(values, .5), sorted[(n - 1) / 2]);
    EXPECT_EQ(median(values), sorted[n / 2]);
    EXPECT_EQ(median(std::span(values).first(1)), values[0]);
  }
}

// The expected numbers are the first ones for seed 1234567 in the reference implementation by S. Vigna.
TEST(SplitMix64, IsTheReferenceGenerator) {
  SplitMix64 random(1234567);
  EXPECT_EQ(random.bits(), 6457827717110365317U);
  EXPECT_EQ(random.bits(), 3203168211198807973U);
  EXPECT_EQ(random.bits(), 9817491932198370423U);
}

TEST(Angle, ConvertsThereAndBack) {
  EXPECT_DOUBLE_EQ(to_radians(180), 3.14159265358979323846);
  EXPECT_DOUBLE_EQ(to_degrees(to_radians(37)), 37);
}

}  // namespace
}  // namespace relievo
