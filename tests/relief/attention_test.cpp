#include "relievo/relief/attention.h"

#include <limits>
#include <numeric>

#include "relievo/relief/frame.h"
#include "relievo/relief/weights.h"
#include "support/same_bits.h"
#include "support/surfaces.h"

namespace relievo {
namespace {

// Returns a square of side 2. Its left half has fine waves, its right half none except a wide bump.
Cloud waves_on_the_left(std::size_t n = 30000) {
  const auto share = [](double x) {
    return x < -.1 ? 1. : x > .1 ? 0. : (1 - std::sin(5 * std::numbers::pi * x)) / 2;
  };
  const auto height = [=](double x, double y) {
    return .3 * std::exp(-2 * (x * x + y * y)) + .01 * share(x) * std::sin(40 * x) * std::sin(40 * y);
  };
  return test::height_field(n, 1, height, [=](double x, double y) -> Vec2 {
    constexpr double d = 1e-5;
    return Vec2(height(x + d, y) - height(x - d, y), height(x, y + d) - height(x, y - d)) / (2 * d);
  });
}

TEST(Attention, IsHighWhereTheSurfaceIsUnlikeItsSurroundings) {
  const Surface surface = test::surface_of(waves_on_the_left());
  const std::vector<float> a = attention(surface);
  EXPECT_EQ(*std::ranges::min_element(a), 0);
  EXPECT_EQ(*std::ranges::max_element(a), 1);
  double left = 0, right = 0, count_left = 0, count_right = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vec3& p = surface.points[i];
    if (std::abs(p.y()) > .6 || std::abs(p.x()) < .2 || std::abs(p.x()) > .6) continue;
    (p.x() < 0 ? left : right) += static_cast<double>(a[i]);
    ++(p.x() < 0 ? count_left : count_right);
  }
  EXPECT_GT(left / count_left, 3 * right / count_right);
}

TEST(Attention, IsZeroWithoutCurvature) {
  for (const float value : attention(test::surface_of(test::sheet(5000, 1, 0)))) EXPECT_EQ(value, 0);
  EXPECT_TRUE(attention(Surface()).empty());
}

// Returns the mean attention in 8 x 8 squares of the view.
std::vector<double> means_of(const Surface& surface) {
  const std::vector<float> a = attention(surface);
  const Box box = Box::of(surface.points);
  std::vector<double> sums(64, 0), counts(64, 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vec3 share = (surface.points[i] - box.min).cwiseQuotient(box.size());
    const auto cell = [](double x) { return std::min<std::size_t>(7, static_cast<std::size_t>(8 * x)); };
    sums[cell(share.x()) + 8 * cell(share.y())] += static_cast<double>(a[i]);
    ++counts[cell(share.x()) + 8 * cell(share.y())];
  }
  for (std::size_t k = 0; k < sums.size(); ++k) sums[k] /= counts[k];
  return sums;
}

// The attention of a model must not depend on the model's size and position. Nor must it depend on the model's rotation
// in space, if the viewer is rotated with it. Rounding may change which points are visible, but only for a few.
TEST(Attention, MovesWithTheModel) {
  const Cloud cloud = waves_on_the_left(20000);
  const Mat3 turn = (Eigen::AngleAxisd(.7, Vec3(1, 2, 3).normalized())).toRotationMatrix();
  Cloud moved = cloud;
  for (Vec3& p : moved.points) p = 7 * (turn * p) + Vec3(10, -20, 5);
  for (Vec3f& n : moved.normals) n = (turn * n.cast<double>()).cast<float>();
  View view{.R_view_model = turn.transpose()};
  const std::vector<double> a = means_of(test::surface_of(cloud)),
                            b = means_of(test::surface_of(moved, view));
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], .02);
}

TEST(Attention, HasTheSameBitsOnAnyNumberOfThreads) {
  const Surface surface = test::surface_of(waves_on_the_left());
  test::expect_same_for_any_threads([&] { return attention(surface); });
}

TEST(Attention, HasLevelsThatAddUpToNothing) {
  const std::vector<float> a{0, .25F, .5F, 1, .75F, 0};
  const double mean = std::accumulate(a.begin(), a.end(), 0.) / 6;
  const std::vector<std::uint16_t> levels = levels_of(a);
  for (std::size_t i = 0; i < a.size(); ++i)
    EXPECT_NEAR(attention_at(levels[i]), static_cast<double>(a[i]) - mean, .5 / attention_steps);
  EXPECT_EQ(attention_at(0), -1);
  EXPECT_EQ(attention_at(attention_levels - 1), 1);
}

Shape with_attention(double exponent) {
  Shape shape = layered_shape();
  shape.attention = exponent;
  return shape;
}

TEST(AttentionWeights, StayBetweenNothingAndAll) {
  Shape shape = with_attention(4);
  for (const double u : {0., .01, 1., 50., std::numeric_limits<double>::infinity()}) {
    shape.compression.u = u;
    const double most = 2 - height_share(shape);
    float last = 0;
    for (double more = -1; more <= 1; more += .125) {
      const LayerWeights weights = layer_weights(shape, more), plain = layer_weights(with_attention(0), more);
      EXPECT_GE(weights.fine, last);
      EXPECT_LE(weights.middle, weights.fine);
      EXPECT_LE(weights.fine, most * (1 + 1e-6));
      if (u == 1) {
        EXPECT_EQ(weights.coarse, plain.coarse);
        EXPECT_NEAR(weights.fine, most * -std::expm1(-std::exp(4 * more)), 1e-6);
      }
      last = weights.fine;
    }
  }
}

// Returns the root mean square of the finest layer of the relief's slopes, at the points for which `is_there` is true.
template <typename IsThere>
double contrast(const Surface& surface, std::span<const double> heights, IsThere&& is_there) {
  const std::vector<float> z(heights.begin(), heights.end());
  const std::vector<PointLayers> layers = normal_layers(surface.points, vertex_normals(surface, z));
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    if (!is_there(i) || surface.boundary.distance[i] < static_cast<float>(6 * surface.rho)) continue;
    sum += static_cast<double>(Vec2f(layers[i].fine).squaredNorm()), ++count;
  }
  return std::sqrt(sum / count);
}

TEST(AttentionWeights, RaiseSlopesWhereAttentionIsHighAndLowerThemElsewhere) {
  const Surface surface = test::surface_of(waves_on_the_left());
  const std::vector<PointLayers> all = normal_layers(surface.points, surface.normals);
  std::vector<PointLayers> layers(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) layers[i].fine = all[i].fine, layers[i].middle = all[i].middle;
  const std::vector<float> weight(all.size(), 1);
  const std::vector<std::uint16_t> levels = levels_of(attention(surface));
  SlopeInput input{surface.normals, surface.curvature.k, weight, surface.curvature.delta, layers};
  std::vector<Vec2> plain(all.size()), emphasised(all.size());
  find_slopes(input, with_attention(0), plain);
  input.attention = levels;
  find_slopes(input, with_attention(1), emphasised);
  std::size_t higher = 0, lower = 0, wrong = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double more = emphasised[i].norm() - plain[i].norm(), above = attention_at(levels[i]);
    if (plain[i].norm() < .01 || std::abs(above) < .05) continue;
    higher += above > 0 && more > 0, lower += above < 0 && more < 0, wrong += above * more < 0;
  }
  EXPECT_GT(higher, 3000U);
  EXPECT_GT(lower, 3000U);
  EXPECT_LT(wrong,
            (higher + lower) / 100);  // fine and middle layer may oppose each other
}

TEST(AttentionOfReliefs, ShiftsContrastToWhereItIsHigh) {
  const ReliefModel model = test::prepared(test::bumps_behind_a_ring(20000));
  const Surface& surface = model.surface();
  const Relief plain = value_of(model.make_at_height(.03, with_attention(0), 1)),
               emphasised = value_of(model.make_at_height(.03, with_attention(2), 1));
  const std::vector<std::uint16_t> levels = levels_of(attention(surface));
  const auto gain = [&](auto&& is_there) {
    return contrast(surface, emphasised.heights, is_there) / contrast(surface, plain.heights, is_there);
  };
  const double high = gain([&](std::size_t i) { return attention_at(levels[i]) > .2; }),
               low = gain([&](std::size_t i) { return attention_at(levels[i]) < -.1; });
  EXPECT_GT(high, 1.02 * low);
  EXPECT_DOUBLE_EQ(emphasised.height, .03);
}

TEST(AttentionOfReliefs, IsThatOfFramesAndLeavesNothingBehind) {
  const ReliefModel model = test::prepared(test::bumps_behind_a_ring(10000));
  const auto frame_of = [](FrameMaker& maker, const Shape& shape) {
    Frame frame;
    maker.make({shape}, frame);
    return frame;
  };
  FrameMaker maker(model);
  const Frame before = frame_of(maker, with_attention(0)), frame = frame_of(maker, with_attention(1.5)),
              after = frame_of(maker, with_attention(0));
  EXPECT_EQ(before.heights, after.heights);
  const Relief relief = model.make(with_attention(1.5));
  for (std::size_t i = 0; i < relief.heights.size(); ++i)
    EXPECT_NEAR(frame.heights[i], relief.heights[i], 2e-3 * relief.height);
  EXPECT_NE(frame.heights, before.heights);
}

}  // namespace
}  // namespace relievo
