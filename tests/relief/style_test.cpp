#include "relief/style.h"

#include <gtest/gtest.h>

#include "relief/weight_table.h"

namespace relievo {
namespace {

// Three points, of which the first is on the boundary.
const std::vector<Vec3f> normals{{.6F, 0, .8F}, {0, -.6F, .8F}, {.36F, .48F, .8F}};
const std::vector<float> k{1, -.5F, .25F}, w_b{0, 1, 1};

template <typename Real>
std::vector<Real> with_detail(double gamma) {
  std::vector<Real> z{0, 4, 10};
  std::vector<HeightSpan<Real>> spans;
  const SlopeInput input{normals, k, w_b};
  RaisedHeights<Real> heights{z, input, spans};
  const Shape shape{{}, gamma};
  PaperWeightsStyle(shape).raise(heights);
  EXPECT_EQ(heights.height, static_cast<double>(heights.measured().size()));
  return z;
}

TEST(PaperWeightsStyle, AddsGammaTimesCurvatureTimesHeight) {
  const std::vector<double> z = with_detail<double>(.1);
  EXPECT_EQ(z[0], 0);  // the boundary stays on the base
  EXPECT_DOUBLE_EQ(z[1], 4 - .1 * .5 * 10);
  EXPECT_DOUBLE_EQ(z[2], 10 + .1 * .25 * 10);
  const std::vector<float> single = with_detail<float>(.1);
  for (std::size_t i = 0; i < z.size(); ++i) EXPECT_FLOAT_EQ(single[i], static_cast<float>(z[i]));
}

TEST(LayeredStyle, RaisesHeightsToTheirShare) {
  std::vector<double> z{0, 4, 10};
  std::vector<HeightSpan<double>> spans;
  const SlopeInput input{normals, k, w_b};
  RaisedHeights<double> heights{z, input, spans};
  Shape shape = layered_shape();
  shape.height_share = .3;
  LayeredStyle(shape).raise(heights);
  EXPECT_DOUBLE_EQ(heights.height, 3);
  EXPECT_EQ(z, (std::vector<double>{0, 4, 10}));
}

// Both precisions use the same formulas, so the slopes of frames equal those of the exact relief.
TEST(Styles, GiveTheSameSlopesInSinglePrecision) {
  std::vector<PointLayers> layers(3);
  for (std::size_t i = 0; i < 3; ++i) layers[i].fine = Vec2f(-normals[i].head<2>());
  const SlopeInput input{normals, k, w_b, .5, layers};
  for (const Style style : {Style::paper_weights, Style::layered})
    for (const double beta : {0.0, .5}) {
      Shape shape{{.7, beta}, .04};
      shape.style = style;
      std::vector<Vec2> exact(3);
      find_slopes(input, shape, exact);
      std::vector<Vec2f> single(3);
      WeightTable weight;
      with_style(shape, [&](const auto& s) {
        weight.fill(input.delta, s.weighted());
        write_slopes<float>(input, s, weight, single);
      });
      EXPECT_EQ(single[0], Vec2f(0, 0));
      for (std::size_t i = 1; i < 3; ++i) {
        EXPECT_GT(exact[i].norm(), .1);
        EXPECT_LT((exact[i] - single[i].cast<double>()).norm(), 1e-4);
      }
    }
}

}  // namespace
}  // namespace relievo
