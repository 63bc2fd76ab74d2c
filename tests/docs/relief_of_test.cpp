// Tests that the example of docs/library.md, compiled unchanged, makes the relief that the page promises.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>

#include "relievo/io/write.h"
#include "relievo/samples/sample.h"

// examples/consumer/relief_of.cpp defines this function.
relievo::Result<std::vector<std::byte>> relief_of(std::span<const std::byte> scan);

namespace {

// Returns the extent along z of a binary STL. The file has a header of 84 bytes and then 50 bytes per
// triangle: first the normal, then the corners.
float z_extent(std::span<const std::byte> stl) {
  float low = std::numeric_limits<float>::infinity(), high = -low;
  for (std::size_t at = 84; at + 50 <= stl.size(); at += 50)
    for (std::size_t corner = 1; corner <= 3; ++corner) {
      float z;
      std::memcpy(&z, stl.data() + at + 12 * corner + 8, sizeof z);
      low = std::min(low, z);
      high = std::max(high, z);
    }
  return high - low;
}

TEST(ReliefOf, MakesAReliefOfFourMillimetresOnAPlateOfThree) {
  const auto scan = relievo::make_sample("shell", {.points = 20000});
  ASSERT_TRUE(scan.has_value());
  const auto stl = relief_of(relievo::write_ply(*scan));
  ASSERT_TRUE(stl.has_value()) << stl.error().message();
  EXPECT_NEAR(z_extent(*stl), 3 + 4, 1e-4);
}

TEST(ReliefOf, ReturnsAnErrorForWhatIsNoScan) {
  const auto stl = relief_of({});
  ASSERT_FALSE(stl.has_value());
  EXPECT_EQ(stl.error().kind, relievo::ErrorKind::input);
}

}  // namespace
