#include "quality/image_measures.h"

#include <gtest/gtest.h>

#include <cmath>

namespace relievo {
namespace {

constexpr int width = 30, height = 20;

// Returns a mask of all pixels that are not in the hole and not within `margin` of the picture's edge.
PixelMask measured(int margin, bool has_hole = false) {
  Image8 is_measured = filled_image(width, height, std::uint8_t{0});
  for (int y = margin; y < height - margin; ++y)
    for (int x = margin; x < width - margin; ++x)
      is_measured.at(x, y) = !(has_hole && std::abs(x - 15) < 3 && y > 8);
  return PixelMask(std::move(is_measured));
}

template <typename F>
Image<float> image(F&& f) {
  Image<float> values = filled_image(width, height, 0.F);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) values.at(x, y) = static_cast<float>(f(x, y));
  return values;
}

TEST(PixelMask, ListsItsPixels) {
  const PixelMask where = measured(2, true);
  std::size_t count = 0;
  for (const std::uint8_t m : where.mask.pixels) count += m;
  EXPECT_EQ(where.pixels.size(), count);
  for (const Index i : where.pixels) ASSERT_TRUE(where.mask[i]);
}

// The field is linear, and its divergence is 0.3 + 0.2. Rows of the picture run downwards, so y
// decreases from row to row.
TEST(Divergence, IsThatOfALinearField) {
  const PixelMask where = measured(1, true);
  const Image<float> sum = divergence(image([](int x, int y) { return .3 * x + 7 * y; }),
                                      image([](int x, int y) { return 5 * x - .2 * y; }), where);
  for (Index i = 0; i < sum.size(); ++i) ASSERT_NEAR(sum[i], where.mask[i] ? .5 : 0, 1e-4) << i;
}

// Pixels in the hole and at the edge have the value 0, but must not count.
TEST(MaskedGaussian, KeepsAConstant) {
  const PixelMask where = measured(2, true);
  Image<float> values = image([&](int x, int y) { return where.mask.at(x, y); });
  MaskedGaussian(2, 6, where).apply(values, where);
  for (const Index i : where.pixels) ASSERT_NEAR(values[i], 1, 1e-5);
}

TEST(MaskedGaussian, IsTheWeightedMeanOfMeasuredPixels) {
  const PixelMask where = measured(1, true);
  const auto value = [](int x, int y) { return std::sin(.7 * x) + .1 * y; };
  Image<float> values = image(value);
  for (Index i = 0; i < values.size(); ++i) values[i] *= where.mask[i];
  MaskedGaussian(1.5, 4, where).apply(values, where);
  for (const Index i : where.pixels) {
    const int px = static_cast<int>(i) % width, py = static_cast<int>(i) / width;
    double sum = 0, weights = 0;
    for (int y = py - 4; y <= py + 4; ++y)
      for (int x = px - 4; x <= px + 4; ++x) {
        if (x < 0 || y < 0 || x >= width || y >= height) continue;
        if (!where.mask.at(x, y)) continue;
        const double w = std::exp(-((x - px) * (x - px) + (y - py) * (y - py)) / (2 * 1.5 * 1.5));
        sum += w * value(x, y), weights += w;
      }
    ASSERT_NEAR(values[i], sum / weights, 1e-5) << px << " " << py;
  }
}

TEST(Correlation, TakesNoNoticeOfScaleAndOffsetNorOfOtherPixels) {
  const PixelMask where = measured(3);
  const Image<float> a = image([](int x, int y) { return std::cos(.4 * x) * y; });
  Image<float> b = a, c = a;
  for (std::size_t i = 0; i < a.size(); ++i) b[i] = 2 * a[i] + 5, c[i] = where.mask[i] ? -a[i] : 1000;
  EXPECT_NEAR(correlation(a, b, where), 1, 1e-6);
  EXPECT_NEAR(correlation(a, c, where), -1, 1e-12);
  EXPECT_EQ(correlation(a, filled_image(width, height, 3.F), where), 0);
  EXPECT_EQ(correlation({}, {}, {}), 0);
}

TEST(OrderKept, CountsPairs) {
  const PixelMask where = measured(1);
  const Image<float> depth = image([](int x, int y) { return x + 100 * y; });
  Image<float> reversed = depth;
  for (float& z : reversed.pixels) z = -z;
  EXPECT_EQ(order_kept(depth, depth, where), 1);
  EXPECT_EQ(order_kept(reversed, depth, where), 0);
  EXPECT_EQ(order_kept(filled_image(width, height, 1.F), depth, where), 0);
  EXPECT_NEAR(order_kept(image([](int x, int) { return x; }), depth, where), .48, .03);
  EXPECT_EQ(order_kept({}, {}, {}), 0);
}

// The heights rise with the depths, except at one cliff. The cliff separates half of all random pairs,
// but only few near pairs.
TEST(NearOrderKept, CountsNearPairsAlone) {
  constexpr int size = 400;
  Image8 inside = filled_image<std::uint8_t>(size, size, 0);
  Image<float> depth = filled_image(size, size, 0.F), z = depth;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      inside.at(x, y) = x > 0 && y > 0 && x + 1 < size && y + 1 < size;
      depth.at(x, y) = static_cast<float>(x);
      z.at(x, y) = static_cast<float>(x < size / 2 ? x : x - size / 2);
    }
  const PixelMask where(inside);
  // A pair across the cliff has the wrong order. The share of these pairs is the mean distance of a pair
  // along x, divided by the width, 400. The distance of near pairs is between 12 and 40, so the mean distance
  // along x is 2 / pi times 2/3 (40^3 - 12^3) / (40^2 - 12^2). Pairs less than 4 apart along x do not count.
  // They are 9 % of all near pairs, so the share is divided by 0.91.
  EXPECT_NEAR(near_order_kept(z, depth, where), 1 - .0499, .003);
  EXPECT_NEAR(order_kept(z, depth, where), .75, .01);
  EXPECT_EQ(near_order_kept(depth, depth, where), 1);
  EXPECT_EQ(near_order_kept({}, {}, {}), 0);
}

// Pairs of pixels whose depths differ by less than 1 % of the range do not count.
TEST(OrderKept, ForgivesWhatIsHardlyApart) {
  const PixelMask where = measured(1);
  const Image<float> depth = image([](int x, int y) { return 1000 * (x > 15) + .5 * y; });
  const Image<float> z = image([](int x, int y) { return 1000 * (x > 15) - .1 * y; });
  EXPECT_EQ(order_kept(z, depth, where), 1);
}

}  // namespace
}  // namespace relievo
