#include "quality/plane_measures.h"

#include <gtest/gtest.h>

#include <cmath>

namespace relievo {
namespace {

constexpr int width = 30, height = 20;

// Everywhere but within `margin` of the rim, and in a hole.
Measured measured(int margin, bool has_hole = false) {
  std::vector<std::uint8_t> is_measured(width * height);
  for (int y = margin; y < height - margin; ++y)
    for (int x = margin; x < width - margin; ++x)
      is_measured[static_cast<std::size_t>(y * width + x)] = !(has_hole && std::abs(x - 15) < 3 && y > 8);
  return {width, std::move(is_measured)};
}

template <typename F>
Plane plane(F&& f) {
  Plane values;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) values.push_back(static_cast<float>(f(x, y)));
  return values;
}

TEST(Measured, ListsItsPixels) {
  const Measured where = measured(2, true);
  std::size_t count = 0;
  for (const std::uint8_t m : where.is_measured) count += m;
  EXPECT_EQ(where.pixels.size(), count);
  for (const Index i : where.pixels) ASSERT_TRUE(where.is_measured[i]);
}

// Rows run down: y falls with them.
TEST(Divergence, IsThatOfALinearField) {
  const Measured where = measured(1, true);
  const Plane sum = divergence(plane([](int x, int y) { return .3 * x + 7 * y; }),
                               plane([](int x, int y) { return 5 * x - .2 * y; }), where);
  for (Index i = 0; i < sum.size(); ++i) ASSERT_NEAR(sum[i], where.is_measured[i] ? .5 : 0, 1e-4) << i;
}

// What lies in the hole and at the rim does not count.
TEST(MeasuredGaussian, KeepsAConstant) {
  const Measured where = measured(2, true);
  Plane values(where.is_measured.begin(), where.is_measured.end());
  MeasuredGaussian(2, 6, where).apply(values, where);
  for (const Index i : where.pixels) ASSERT_NEAR(values[i], 1, 1e-5);
}

TEST(MeasuredGaussian, IsTheWeightedMeanOfMeasuredPixels) {
  const Measured where = measured(1, true);
  const auto value = [](int x, int y) { return std::sin(.7 * x) + .1 * y; };
  Plane values = plane(value);
  for (Index i = 0; i < values.size(); ++i) values[i] *= where.is_measured[i];
  MeasuredGaussian(1.5, 4, where).apply(values, where);
  for (const Index i : where.pixels) {
    const int px = static_cast<int>(i) % width, py = static_cast<int>(i) / width;
    double sum = 0, weights = 0;
    for (int y = py - 4; y <= py + 4; ++y)
      for (int x = px - 4; x <= px + 4; ++x) {
        if (x < 0 || y < 0 || x >= width || y >= height) continue;
        if (!where.is_measured[static_cast<std::size_t>(y * width + x)]) continue;
        const double w = std::exp(-((x - px) * (x - px) + (y - py) * (y - py)) / (2 * 1.5 * 1.5));
        sum += w * value(x, y), weights += w;
      }
    ASSERT_NEAR(values[i], sum / weights, 1e-5) << px << " " << py;
  }
}

TEST(Correlation, TakesNoNoticeOfScaleAndOffsetNorOfOtherPixels) {
  const Measured where = measured(3);
  const Plane a = plane([](int x, int y) { return std::cos(.4 * x) * y; });
  Plane b = a, c = a;
  for (std::size_t i = 0; i < a.size(); ++i) b[i] = 2 * a[i] + 5, c[i] = where.is_measured[i] ? -a[i] : 1000;
  EXPECT_NEAR(correlation(a, b, where), 1, 1e-6);
  EXPECT_NEAR(correlation(a, c, where), -1, 1e-12);
  EXPECT_EQ(correlation(a, Plane(a.size(), 3), where), 0);
  EXPECT_EQ(correlation({}, {}, {}), 0);
}

TEST(OrderKept, CountsPairs) {
  const Measured where = measured(1);
  const Plane depth = plane([](int x, int y) { return x + 100 * y; });
  Plane reversed = depth;
  for (float& z : reversed) z = -z;
  EXPECT_EQ(order_kept(depth, depth, where, 2000), 1);
  EXPECT_EQ(order_kept(reversed, depth, where, 2000), 0);
  EXPECT_EQ(order_kept(Plane(depth.size(), 1), depth, where, 2000), 0);
  EXPECT_NEAR(order_kept(plane([](int x, int) { return x; }), depth, where, 20000), .48, .03);
  EXPECT_EQ(order_kept({}, {}, {}, 100), 0);
}

// Pairs less than 1 % of the range apart do not count.
TEST(OrderKept, ForgivesWhatIsHardlyApart) {
  const Measured where = measured(1);
  const Plane depth = plane([](int x, int y) { return 1000 * (x > 15) + .5 * y; });
  const Plane z = plane([](int x, int y) { return 1000 * (x > 15) - .1 * y; });
  EXPECT_EQ(order_kept(z, depth, where, 5000), 1);
}

}  // namespace
}  // namespace relievo
