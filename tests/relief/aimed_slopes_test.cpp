#include "relief/aimed_slopes.h"

#include <random>

#include "relievo/relief/frame.h"
#include "support/surfaces.h"

namespace relievo {
namespace {

double shading_of(const Vec2& slope, const Vec3& l) {
  return Vec3(-slope.x(), -slope.y(), 1).normalized().dot(l);
}

TEST(AimedSlope, HasTheShadingAndKeepsWhatIsAcrossTheLight) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> slope(-1, 1), azimuth(-180, 180), elevation(10, 80),
      shading(.05, .95);
  int changed = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 l = direction_of({azimuth(random), elevation(random)});
    const Vec2 s(slope(random), slope(random)), across(-l.y(), l.x());
    const double wanted = shading(random);
    const Vec2 aimed = aimed_slope<double>(s, l, wanted);
    EXPECT_NEAR(aimed.dot(across), s.dot(across), 1e-9);
    if (aimed == s) continue;
    ++changed;
    EXPECT_NEAR(shading_of(aimed, l), wanted, 1e-9);
    // On the line through `s` along the light, no slope nearer to `s` than `aimed` has this shading.
    const Vec2 along = Vec2(l.head<2>()).normalized();
    const double distance = (aimed - s).norm();
    for (double t = -.97; t < .98; t += .01) {
      const double before = shading_of(s + (t - .01) * distance * along, l),
                   after = shading_of(s + t * distance * along, l);
      EXPECT_FALSE((before - wanted) * (after - wanted) < 0 && before > 0 && after > 0);
    }
  }
  EXPECT_GT(changed, 800);
}

TEST(AimedSlope, StaysWhereNoSlopeHasTheShading) {
  // If the slope across the light is 3, the shading is at most sqrt(l_z^2 / 10 + h^2), whatever the slope
  // along the light is. Here, h is the length of (l_x, l_y).
  const Vec3 l = direction_of({0, 60});
  EXPECT_EQ(aimed_slope<double>({.3, 3}, l, .9), Vec2(.3, 3));
}

TEST(LocalContrast, IsThatOfWavesAndNoneOfAPlane) {
  const auto level = test::surface_of(test::sheet(20000, 1, 0));
  for (const float contrast : local_contrast(level, {45, 30})) EXPECT_NEAR(contrast, 0, 1e-5);
  const double k = 80, slope = .2;
  const auto waves = test::surface_of(test::height_field(
      40000, 1, [=](double x, double) { return slope / k * std::sin(k * x); },
      [=](double x, double) { return Vec2(slope * std::cos(k * x), 0); }));
  const Vec3 l = direction_of({0, 30});
  const std::vector<float> contrast = local_contrast(waves, {0, 30});
  double error = 0, count = 0;
  for (std::size_t i = 0; i < contrast.size(); ++i) {
    const Vec3& p = waves.points[i];
    if (p.head<2>().cwiseAbs().maxCoeff() > .8) continue;
    const double shading = shading_of(Vec2(slope * std::cos(k * p.x()), 0), l);
    error += std::abs(static_cast<double>(contrast[i]) - shading + l.z() / std::sqrt(1 + slope * slope / 2));
    ++count;
  }
  EXPECT_LT(error / count, .01);
}

TEST(Light, IsParsed) {
  EXPECT_EQ(value_of(parse_light("135,30")), (LightDirection{135, 30}));
  for (const char* text : {"", "135", "135,", "135,3", "400,30", "a,b", "1,2,3"})
    EXPECT_FALSE(parse_light(text)) << text;
}

// Returns the correlation between the local contrasts of a relief and those of its model, under the same
// light.
double agreement(const ReliefModel& model, const Shape& shape, const LightDirection& light) {
  const Relief relief = value_of(model.make_at_height(.15, shape, 1));
  Surface made = model.surface();
  made.normals = vertex_normals(made, std::vector<float>(relief.heights.begin(), relief.heights.end()));
  const std::vector<float> own = local_contrast(made, light), wanted = local_contrast(model.surface(), light);
  double sum = 0, own_sq = 0, wanted_sq = 0;
  for (std::size_t i = 0; i < own.size(); ++i) {
    if (made.boundary.distance[i] < static_cast<float>(4 * made.rho)) continue;
    const auto a = static_cast<double>(own[i]), b = static_cast<double>(wanted[i]);
    sum += a * b, own_sq += a * a, wanted_sq += b * b;
  }
  return sum / std::sqrt(own_sq * wanted_sq);
}

TEST(Light, OfAShapeBringsTheContrastUnderIt) {
  const ReliefModel model = test::prepared(test::bumps_behind_a_ring(20000));
  Shape lit = layered_shape();
  lit.light = ReliefLight{{0, 30}, 1};
  EXPECT_GT(agreement(model, lit, lit.light->from), agreement(model, layered_shape(), lit.light->from) + .01);
}

}  // namespace
}  // namespace relievo
