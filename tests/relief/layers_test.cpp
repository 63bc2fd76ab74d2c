#include "relievo/relief/layers.h"

#include <limits>

#include "relief/layered_slopes.h"
#include "relievo/relief/weights.h"
#include "support/surfaces.h"

namespace relievo {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

using test::surface_of;

// Returns a wave of the given length along x, with slopes up to 0.2, on a square of side 2.
Surface wavy(double length) {
  const double k = 2 * std::numbers::pi / length, a = .2 / k;
  return surface_of(test::height_field(
      60000, 1, [=](double x, double) { return a * std::sin(k * x); },
      [=](double x, double) { return Vec2(a * k * std::cos(k * x), 0); }));
}

std::vector<PointLayers> layers_of(const Surface& surface) {
  return normal_layers(surface.points, surface.normals);
}

// Returns the root mean square of a layer. Points near the rim do not count.
template <typename Layer>
double size_of(const Surface& surface, Layer layer) {
  const std::vector<PointLayers> layers = layers_of(surface);
  double sum = 0, n = 0;
  for (std::size_t i = 0; i < surface.points.size(); ++i)
    if (surface.points[i].head<2>().cwiseAbs().maxCoeff() < .7)
      sum += static_cast<double>(layer(layers[i]).squaredNorm()), ++n;
  return std::sqrt(sum / n);
}

Vec2f sum(const PointLayers& l) {
  return Vec2f(l.fine) + Vec2f(l.middle) + Vec2f(l.coarse) + Vec2f(l.broad);
}

// The largest error of the sum of four layers after rounding.
constexpr float rounding = 4 * LayerXy::unit;

TEST(LayerXy, KeepsWhatItIsGivenToAPart) {
  for (const Vec2f& xy : {Vec2f(0, 0), Vec2f(1, -1), Vec2f(.12345F, -1.98765F), Vec2f(1e-6F, .5F)})
    EXPECT_LE((Vec2f(LayerXy(xy)) - xy).cwiseAbs().maxCoeff(), LayerXy::unit / 2);
  EXPECT_LT((Vec2f(LayerXy({9, -9})) - Vec2f(2, -2)).norm(), 2 * LayerXy::unit);
}

TEST(Layers, AddUpToTheNormal) {
  const Surface sphere = surface_of(test::sphere(20000, 1));
  const std::vector<PointLayers> layers = layers_of(sphere);
  for (std::size_t i = 0; i < sphere.points.size(); ++i) {
    if (sphere.normals[i].z() < .6F) continue;
    ASSERT_LT((sum(layers[i]) + sphere.normals[i].head<2>()).norm(), rounding);
  }
}

TEST(Layers, FadeOutWhereTheSurfaceTurnsAway) {
  std::vector<Vec3> points;
  std::vector<Vec3f> normals;
  for (const double slope : {1.0, 12.0, 100.0}) {
    points.emplace_back(10.0 * static_cast<double>(points.size()), static_cast<double>(points.size() % 2), 0);
    normals.push_back(Vec3(-slope, 0, 1).normalized().cast<float>());
  }
  const auto layers = normal_layers(points, normals);
  const auto kept = [&](std::size_t i) { return -sum(layers[i]).x() / normals[i].x(); };
  EXPECT_NEAR(kept(0), 1, 2 * rounding);
  EXPECT_NEAR(kept(1), .5, 2 * rounding);
  EXPECT_LT(kept(2), 2 * rounding);
}

// -(n_x, n_y) points uphill. faded_xy() must return this vector times 1 / (1 + (slope / 12)^8).
TEST(FadedXy, IsTheShareThatItsSlopeLeaves) {
  for (const double slope : {0.0, .5, 3.0, 12.0, 24.0}) {
    const Vec3 normal = Vec3(-.6 * slope, .8 * slope, 1).normalized();
    const Vec2 expected = -normal.head<2>() / (1 + std::pow(slope / 12, 8));
    EXPECT_LT((faded_xy(normal.cast<float>()).cast<double>() - expected).norm(), 1e-6) << slope;
  }
  EXPECT_LT(faded_xy(Vec3f(1, 0, 0)).norm(), 1e-9F);
  EXPECT_LT(faded_xy(Vec3f(.8F, 0, -.6F)).norm(), 1e-9F);
}

// The numbers and weights are chosen so that exchanging any of them would change the sum.
TEST(WeightedSum, WeighsEachLayer) {
  const PointLayers layers{Vec2f(.5F, .25F), Vec2f(-.25F, .125F), Vec2f(1, -.5F), Vec2f(-.125F, 1.5F)};
  const LayerWeights w{.1F, .35F, .7F, .9F, .5F};
  const Vec2f expected(.1F * .5F - .35F * .25F + .7F - .9F * .125F,
                       .1F * .25F + .35F * .125F - .7F * .5F + .9F * 1.5F);
  EXPECT_LT((weighted_sum(layers, w) - expected).norm(), 1e-6F);
  EXPECT_EQ(weighted_sum(layers, {}), Vec2f(0, 0));
}

TEST(Layers, ContainWhatTheirSizeSays) {
  const auto fine = [](const PointLayers& l) { return Vec2f(l.fine); };
  const auto middle = [](const PointLayers& l) { return Vec2f(l.middle); };
  const auto coarse = [](const PointLayers& l) { return Vec2f(l.coarse); };
  const auto broad = [](const PointLayers& l) { return Vec2f(l.broad); };
  const Surface ripples = wavy(.02), waves = wavy(.15), bumps = wavy(1), swell = wavy(8);
  EXPECT_GT(size_of(ripples, fine), 2 * size_of(ripples, middle));
  EXPECT_GT(size_of(waves, middle), 2 * size_of(waves, fine));
  EXPECT_GT(size_of(waves, middle), 2 * size_of(waves, coarse));
  EXPECT_GT(size_of(bumps, coarse), 2 * size_of(bumps, broad));
  EXPECT_GT(size_of(swell, broad), 2 * size_of(swell, coarse));
}

TEST(LayerWeights, AreEquationSixPerLayerTimesTwoMinusTheShare) {
  for (const double u : {.1, 1.0, 5.0}) {
    const double share = .3 + .1 * u, more = 2 - share;
    const LayerWeights even = LayerWeights::of(u, 0, share);
    EXPECT_FLOAT_EQ(even.fine, static_cast<float>(more * (1 - std::exp(-u))));
    EXPECT_EQ(even.middle, even.fine);
    EXPECT_EQ(even.coarse, even.fine);
    EXPECT_EQ(even.broad, even.fine);
    const LayerWeights attenuated = LayerWeights::of(u, .04, share);
    EXPECT_EQ(attenuated.fine, even.fine);
    EXPECT_LT(attenuated.middle, attenuated.fine);
    EXPECT_LT(attenuated.coarse, attenuated.middle);
    EXPECT_FLOAT_EQ(attenuated.broad, static_cast<float>(more * (1 - std::exp(-u * std::exp(-2.2)))));
  }
  EXPECT_EQ(LayerWeights::of(infinity, .04, 1).broad, 1);
  EXPECT_EQ(LayerWeights::of(0, .04, .5).fine, 0);
  EXPECT_EQ(LayerWeights::of(2, .04, .5).height_share, .5F);
}

TEST(LayerWeights, OfAShapeAreThoseOfItsHeightShare) {
  Shape shape = layered_shape();
  shape.compression.u = 1.5;
  shape.gamma = .02;
  shape.height_share = .6;
  const LayerWeights weights = layer_weights(shape);
  const auto of_layer = [&](double attenuation) {
    return static_cast<float>((2 - .6) * (1 - std::exp(-1.5 * std::exp(-attenuation * .02))));
  };
  EXPECT_FLOAT_EQ(weights.fine, of_layer(0));
  EXPECT_FLOAT_EQ(weights.middle, of_layer(10));
  EXPECT_FLOAT_EQ(weights.coarse, of_layer(20.5));
  EXPECT_FLOAT_EQ(weights.broad, of_layer(55));
  EXPECT_FLOAT_EQ(weights.height_share, .6F);
  shape.height_share.reset();  // the default applies again
  EXPECT_FLOAT_EQ(layer_weights(shape).height_share, static_cast<float>(1 - .6 * std::exp(-.2 * 1.5)));
}

// With weights of 1, the slope is that of the surface. Other weights multiply the x and y of the normal; the
// slope is then that of the changed normal.
TEST(LayeredSlope, IsThatOfTheWeightedNormal) {
  PointLayers layers;
  layers.fine = Vec2f(.3F, 0);
  layers.coarse = Vec2f(.3F, -.2F);
  const Vec2 whole = layered_slope(layers, {1, 1, 1, 0}, 1.0, 100.0);
  const double nz = std::sqrt(1 - .6 * .6 - .2 * .2);
  EXPECT_NEAR((whole - Vec2(.6, -.2) / nz).norm(), 0, 2 * rounding);
  const Vec2 half = layered_slope(layers, {.5F, 1, .5F, 0}, 1.0, 100.0);
  EXPECT_NEAR((half - Vec2(.3, -.1) / std::sqrt(1 - .1)).norm(), 0, 2 * rounding);
  const Vec2 flat = layered_slope(layers, {1, 1, 1, 0}, 0.0, 100.0);
  EXPECT_EQ(flat.norm(), 0);
}

// With a height share t, the slope must be (x, y) / sqrt(1 - t^2 (x^2 + y^2)), where (x, y) is the weighted
// sum. The root anticipates the tilt that remains after compression.
TEST(LayeredSlope, AnticipatesTheMembrane) {
  PointLayers layers;
  layers.coarse = Vec2f(.6F, -.2F);
  const auto slope = [&](float share) { return layered_slope(layers, {1, 1, 1, 1, share}, 1.0, 100.0); };
  EXPECT_NEAR((slope(0) - Vec2(.6, -.2)).norm(), 0, 2 * rounding);
  EXPECT_NEAR((slope(.5F) - Vec2(.6, -.2) / std::sqrt(1 - .25 * .4)).norm(), 0, 2 * rounding);
}

TEST(LayeredSlope, IsNeverSteeperThanAllowed) {
  PointLayers layers;
  for (const float x : {.2F, .96F, .9999F, 1.F, 1.9F}) {
    layers.coarse = Vec2f(0, x);
    for (const double most : {.1, 1.0, 4.0}) {
      for (const float share : {.5F, 1.F}) {
        const Vec2 slope = layered_slope(layers, {1, 1, 1, 1, share}, 1.0, most);
        EXPECT_LE(slope.norm(), most * (1 + 1e-12)) << x;
        EXPECT_GT(slope.y(), 0);
      }
    }
  }
}

}  // namespace
}  // namespace relievo
