#include "relief/layered_slopes.h"

#include <gtest/gtest.h>

#include "relief/style.h"
#include "relief/weight_table.h"
#include "support/shapes.h"

namespace relievo {
namespace {

// Points with all kinds of normals: level, steep, and steeper than the steepest allowed slope.
struct Points {
  std::vector<Vec3f> normals;
  std::vector<float> k, boundary_weight;
  std::vector<PointLayers> layers;
  std::vector<std::uint16_t> attention;
  SlopeInput input;

  explicit Points(std::size_t n) {
    test::Random random(5);
    const auto xy = [&] {
      return Vec2f(static_cast<float>(random.uniform(-.7, .7)), static_cast<float>(random.uniform(-.7, .7)));
    };
    for (std::size_t i = 0; i < n; ++i) {
      normals.emplace_back(0, 0, 1);
      k.push_back(i % 10 == 0 ? 0 : static_cast<float>(random.uniform(-1, 1)));
      boundary_weight.push_back(static_cast<float>(random.uniform()));
      attention.push_back(static_cast<std::uint16_t>(random.uniform(0, attention_levels)));
      layers.push_back(i % 7 == 0 ? PointLayers{} : PointLayers{xy(), xy(), xy(), xy()});
    }
    input = {normals, k, boundary_weight, .3, layers};
  }
};

// Computes slopes eight points at a time, with and without AVX2, and compares them with slopes computed one
// by one. The number of points is not a multiple of eight.
void expect_slopes_of_single_points(const Shape& shape) {
  Points points(10003);
  if (shape.attention > 0) points.input.attention = points.attention;
  const LayeredStyle style(shape);
  WeightTable weight;
  weight.fill(points.input.delta, style.weighted());
  std::vector<Vec2f> single(points.k.size());
  write_slopes<float>(points.input, style, weight, std::span<Vec2f>(single));
  for (const bool is_wide : {true, false}) {
    allow_avx2(is_wide);
    std::vector<Vec2f> many(points.k.size());
    write_slopes_by_eight(points.input, style, weight, many);
    EXPECT_EQ(many, single);
  }
  allow_avx2(true);
}

TEST(LayeredSlopes, AreThoseOfSinglePointsToTheLastBit) {
  Shape shape = layered_shape();
  for (const double share : {0., .7, 1.}) {
    shape.height_share = share;
    expect_slopes_of_single_points(shape);
  }
  shape.compression = {.5, 1.5};
  shape.max_slope = .6;
  expect_slopes_of_single_points(shape);
  shape.attention = 2;
  expect_slopes_of_single_points(shape);
}

}  // namespace
}  // namespace relievo
