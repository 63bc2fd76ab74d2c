#include "relievo/relief/frame.h"

#include "support/differences.h"
#include "support/same_bits.h"
#include "support/surfaces.h"

namespace relievo {
namespace {

using test::largest_difference;

const ReliefModel& model() {
  static const ReliefModel made = test::prepared(test::bumps_behind_a_ring());
  return made;
}

const ReliefModel& subspace_model() {
  static const ReliefModel made = ReliefModel::prepare(model().surface(), nullptr, {Mode::subspace}).value();
  return made;
}

Frame frame_of(const FrameOptions& options) {
  FrameMaker maker(model());
  Frame frame;
  maker.make(options, frame);
  return frame;
}

TEST(Frame, AgreesWithTheExactRelief) {
  for (const auto& [style, tolerance] : {std::pair(Style::paper_weights, 1e-5), {Style::layered, 1e-4}})
    for (const double beta : {0.0, .01, 1.0, 2.0})
      for (const double u : {.3, .7, 2.0}) {
        FrameOptions options{.shape = {{u, beta}, .04}};
        options.shape.style = style;
        const Relief exact = model().make(options.shape);
        const Frame frame = frame_of(options);
        EXPECT_LT(largest_difference(frame.heights, exact.heights), tolerance * exact.height)
            << u << ' ' << beta;
        EXPECT_NEAR(frame.height / exact.height, 1, tolerance) << u << ' ' << beta;
      }
}

// The expected normal of a point is the sum of the cross products of the point's triangles, normalised.
TEST(Frame, NormalsAreTheMeanOfTheTrianglesAround) {
  const Frame frame = frame_of({});
  const Surface& surface = model().surface();
  std::vector<Vec3> sums(surface.points.size(), Vec3::Zero());
  const auto at = [&](Index i) {
    return Vec3(surface.points[i].x(), surface.points[i].y(), static_cast<double>(frame.heights[i]));
  };
  for (std::size_t t = 0; t < surface.triangulation.triangles.size(); ++t) {
    if (!surface.boundary.is_inside[t]) continue;
    const auto [a, b, c] = surface.triangulation.triangles[t];
    for (const Index corner : {a, b, c}) sums[corner] += (at(b) - at(a)).cross(at(c) - at(a));
  }
  const std::vector<Vec3f> normals = vertex_normals(surface, frame.heights);
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const Vec3 normal = sums[i].norm() > 0 ? Vec3(sums[i].normalized()) : Vec3(Vec3::UnitZ());
    ASSERT_LT((frame.normals[i].cast<double>() - normal).norm(), 2e-4);
    ASSERT_LT((frame.normals[i] - normals[i]).norm(), 1e-5F);
  }
}

TEST(Frame, AreCompressedAsTheirShapeSays) {
  FrameMaker maker(model());
  Frame frame;
  FrameOptions options{Shape{}};
  options.shape = layered_shape();
  for (const std::optional<double>& share : {std::optional<double>(), {.6}, {.9}, {}}) {
    options.shape.height_share = share;
    maker.make(options, frame);
    const Relief exact = model().make(options.shape);
    EXPECT_LE(largest_difference(frame.heights, exact.heights), 1e-4 * exact.height);
  }
}

// Expects that a locked height stays the same while other options change. `shares` are the locked
// heights as fractions of the diagonal.
void expect_locked_heights(const ReliefModel& m, Style style, std::span<const double> shares) {
  FrameMaker maker(m);
  Frame frame;
  FrameOptions options{Shape{}};
  for (const double share : shares) {
    options.height = share * m.surface().diagonal;
    for (const double beta : style == Style::layered ? std::vector{0.} : std::vector{0., .01, .5, 5., .2})
      for (const double gamma : {0.0, .04, .1}) {
        options.shape = {{1, beta}, gamma};
        options.shape.style = style;
        maker.make(options, frame);
        ASSERT_TRUE(frame.is_height_met) << share << ' ' << beta << ' ' << gamma;
        ASSERT_NEAR(frame.height / *options.height, 1, 1e-3) << share << ' ' << beta << ' ' << gamma;
      }
  }
}

TEST(Frame, KeepsALockedHeightWhileOthersMove) {
  expect_locked_heights(model(), Style::layered, std::array{.05, .0125, .09});
  expect_locked_heights(model(), Style::paper_weights, std::array{.05, .0125, .1});
  expect_locked_heights(subspace_model(), Style::paper_weights, std::array{.05});
}

TEST(Frame, FollowsASliderInTwoSolves) {
  FrameMaker maker(model());
  Frame frame;
  FrameOptions options{Shape{}};
  options.height = .025 * model().surface().diagonal;
  maker.make(options, frame);
  maker.make(options, frame);
  EXPECT_EQ(frame.times.solves, 1);
  int solves = 0;
  for (int step = 1; step <= 20; ++step) {
    options.shape.gamma = .002 * step;
    maker.make(options, frame);
    solves += frame.times.solves;
  }
  EXPECT_LE(solves, 50);
}

TEST(Frame, FollowsASliderInOneSolveWhereHeightsMayDiffer) {
  FrameMaker maker(model());
  Frame frame;
  FrameOptions options{Shape{}};
  options.height = .025 * model().surface().diagonal;
  options.height_tolerance = .03;
  int solves = 0;
  for (int step = 0; step <= 20; ++step) {
    options.shape.gamma = .002 * step;
    maker.make(options, frame);
    ASSERT_NEAR(frame.height / *options.height, 1, .031);
    solves += frame.times.solves;
  }
  EXPECT_LE(solves, 26);
}

TEST(Frame, TellsThatAHeightIsOutOfReach) {
  const ReliefModel smooth = test::prepared(test::sphere(30000, 1));  // a sphere has no depth jumps
  FrameMaker maker(smooth);
  Frame frame;
  FrameOptions options{Shape{}};
  options.height = 10 * smooth.surface().diagonal;
  maker.make(options, frame);
  EXPECT_FALSE(frame.is_height_met);
  const double highest = frame.height;
  options.height = .99 * highest;
  maker.make(options, frame);
  EXPECT_TRUE(frame.is_height_met);
  EXPECT_LT(frame.height, highest);
}

// A wider boundary makes the rim less steep. The inner part becomes lower together with the rim, but its
// slopes do not change.
TEST(Frame, AWiderBoundaryLowersTheRimOnly) {
  FrameOptions options{Shape{}};
  const Frame narrow = frame_of(options);
  options.shape.boundary_width = 8;
  const Frame wide = frame_of(options);
  EXPECT_LT(wide.height, narrow.height);
  const Surface& surface = model().surface();
  double narrow_tilt = 0, wide_tilt = 0, change = 0, inner_tilt = 0;
  for (std::size_t i = 0; i < surface.points.size(); ++i) {
    const double distance = static_cast<double>(surface.boundary.distance[i]) / surface.rho;
    const Vec2f before = narrow.normals[i].head<2>(), after = wide.normals[i].head<2>();
    if (distance < 3) narrow_tilt += before.norm(), wide_tilt += after.norm();
    if (distance > 24) inner_tilt += before.norm(), change += (after - before).norm();
  }
  EXPECT_LT(wide_tilt, .5 * narrow_tilt);
  EXPECT_LT(change, .03 * inner_tilt);
}

TEST(Frame, KnowsItsLowestAndHighestPoints) {
  FrameOptions options{Shape{}};
  const auto expect_both = [&] {
    const Frame frame = frame_of(options);
    const auto [lowest, highest] = std::ranges::minmax(frame.heights);
    EXPECT_EQ(frame.lowest, std::min(lowest, 0.F));
    EXPECT_EQ(frame.highest, std::max(highest, 0.F));
  };
  expect_both();
  options.shape = layered_shape();
  expect_both();
  options.height = .2;
  expect_both();
}

TEST(Frame, OfASubspaceIsItsRelief) {
  FrameOptions options{Shape{}};
  options.shape = {{.7, .5}, .04};
  options.shape.boundary_width = 3;
  FrameMaker maker(subspace_model());
  Frame frame;
  maker.make(options, frame);
  const Relief relief = subspace_model().make(options.shape);
  EXPECT_LE(largest_difference(frame.heights, relief.heights), 1e-5 * relief.height);
}

TEST(Frame, HasTheSameBitsForAnyNumberOfThreads) {
  test::expect_same_for_any_threads([] {
    const Frame frame = frame_of({});
    return std::pair(frame.heights, frame.normals);
  });
}

}  // namespace
}  // namespace relievo
