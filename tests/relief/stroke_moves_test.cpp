#include <Eigen/QR>

#include "support/strokes.h"

namespace relievo {
namespace {

using test::applied, test::painted, test::place_of, test::surface_of, test::waves;

Stroke protecting(const Vec3& at, double radius, double amount = 1) {
  return test::dab(Brush::protect, at, radius, amount);
}

// Heights with waves, and the same heights after a smooth correction that is not linear.
struct Corrected {
  std::vector<double> before, after;
};

Corrected corrected_waves(const Surface& surface) {
  Corrected heights{waves(surface), {}};
  for (Index i = 0; i < heights.before.size(); ++i) {
    const Vec3& p = surface.points[i];
    heights.after.push_back(.8 * heights.before[i] + .1 * p.x() - .2 * p.y() * p.y());
  }
  return heights;
}

std::vector<double> protect(const Surface& surface, const Stroke& stroke, const Corrected& heights,
                            double height) {
  return applied(surface, {stroke}, heights.after, height, heights.before);
}

// Under a protected stroke, the heights may differ from the heights before the correction only by a linear function.
TEST(StrokeMoves, ProtectShapesFromTheCorrection) {
  const Surface surface = surface_of(test::sheet(20000, 1, 0));
  const Corrected heights = corrected_waves(surface);
  Stroke stroke = protecting({.1, .2, 0}, .4);
  stroke.softness = .25;
  const std::vector<double> z = protect(surface, stroke, heights, 9);
  std::vector<Index> inside;
  for (Index i = 0; i < z.size(); ++i)
    if ((place_of(surface, i) - Vec3(.1, .2, 0)).norm() < .29) inside.push_back(i);
  Eigen::MatrixXd terms(inside.size(), 3);
  Eigen::VectorXd moved(inside.size());
  for (std::size_t k = 0; k < inside.size(); ++k) {
    const Vec3& p = surface.points[inside[k]];
    terms.row(static_cast<Eigen::Index>(k)) << 1, p.x(), p.y();
    moved[static_cast<Eigen::Index>(k)] = z[inside[k]] - heights.before[inside[k]];
  }
  const Eigen::VectorXd plane = terms.householderQr().solve(moved);
  EXPECT_LT((terms * plane - moved).cwiseAbs().maxCoeff(), 1e-9);
  double before = 0, after = 0, weight = 0;  // on average, the stroke neither rises nor sinks
  const StrokeMask mask = stroke_mask(surface, stroke);
  for (std::size_t k = 0; k < mask.points.size(); ++k) {
    const auto w = static_cast<double>(mask.weights[k]);
    const auto lifted = (z[mask.points[k]] - heights.after[mask.points[k]]) / w;
    after += w * lifted, before += w * std::abs(lifted), weight += w;
  }
  EXPECT_LT(std::abs(after), 1e-6 * weight);
  EXPECT_GT(before, .005 * weight);
}

TEST(StrokeMoves, ProtectWithinTheHeight) {
  const Surface surface = surface_of(test::sheet(20000, 1, 0));
  const Corrected heights = corrected_waves(surface);
  const double height = *std::ranges::max_element(heights.after);
  const std::vector<double> z = protect(surface, protecting({-.3, .2, 0}, .5), heights, height);
  EXPECT_LE(*std::ranges::max_element(z), height + 1e-12);
}

TEST(StrokeMoves, ProtectByTheirAmount) {
  const Surface surface = surface_of(test::sheet(20000, 1, 0));
  const Corrected heights = corrected_waves(surface);
  const auto half = protect(surface, protecting({.1, .2, 0}, .4, .5), heights, 9),
             whole = protect(surface, protecting({.1, .2, 0}, .4, 1), heights, 9);
  for (std::size_t i = 0; i < half.size(); ++i)
    EXPECT_NEAR(half[i] - heights.after[i], (whole[i] - heights.after[i]) / 2, 1e-12);
  EXPECT_NE(half, whole);
}

TEST(StrokeMoves, StandInFrontOfWhatIsBehindThem) {
  // The left half of the square is in front of the right half, but in the relief it is hardly higher.
  const Surface surface = test::step(.25);
  std::vector<double> z;
  for (const Vec3& p : surface.points) z.push_back(.4 + .02 * std::sin(9 * p.y()) + (p.x() < 0 ? .03 : 0.));
  Stroke stroke{
      .brush = Brush::in_front, .amount = .2, .radius = .3, .points = {{-.05, -.3, .25}, {-.05, .3, .25}}};
  const std::vector<double> changed = applied(surface, {stroke}, z);
  const std::vector<float> weights = test::weights_of(surface, stroke);
  double least = 1;
  std::size_t pairs = 0;
  for (std::size_t t = 0; t < surface.triangulation.triangles.size(); ++t)
    for (const Index a : surface.triangulation.triangles[t])
      for (const Index b : surface.triangulation.triangles[t])
        if (weights[a] >= .5F && surface.points[b].z() < surface.points[a].z() - .1) {
          least = std::min(least, changed[a] - changed[b]);
          ++pairs;
        }
  ASSERT_GT(pairs, 50U);
  EXPECT_NEAR(least, .2, 1e-9);  // as far in front as requested, and no farther
  for (Index i = 0; i < z.size(); ++i) {
    EXPECT_TRUE(weights[i] > 0 || changed[i] == z[i]);
    EXPECT_GE(changed[i], z[i]);
  }
  for (Index i = 0; i < z.size(); ++i)
    if (surface.points[i].z() > 0) z[i] += .5;
  EXPECT_EQ(applied(surface, {stroke}, z), z);  // points that are far enough in front do not move
}

// A stroke that takes back a part of the correction must not change anything outside of the stroke.
TEST(StrokeMoves, ProtectNothingElse) {
  const ReliefModel model = test::prepared(test::bumps_behind_a_ring(10000));
  Stroke stroke = protecting({-.2, .2, -1.117}, .3);
  const Relief plain = value_of(model.make_at_height(.2, layered_shape(), 1)),
               changed = value_of(model.make_at_height(.2, painted({stroke}), 1));
  std::vector<std::uint8_t> is_painted(plain.heights.size(), 0);
  for (const Index i : stroke_mask(model.surface(), stroke).points) is_painted[i] = 1;
  double most = 0;
  for (std::size_t i = 0; i < plain.heights.size(); ++i) {
    const double moved = std::abs(changed.heights[i] - plain.heights[i]);
    EXPECT_TRUE(is_painted[i] || moved < 1e-12);
    most = std::max(most, moved);
  }
  EXPECT_GT(most, .01 * .2);
  const Frame frame = test::frame_of(model, {painted({stroke}), .2, 1e-5});
  for (std::size_t i = 0; i < plain.heights.size(); ++i)
    EXPECT_NEAR(frame.heights[i], changed.heights[i], 2e-3 * .2);
  stroke.is_muted = true;
  EXPECT_EQ(value_of(model.make_at_height(.2, painted({stroke}), 1)).heights, plain.heights);
}

}  // namespace
}  // namespace relievo
