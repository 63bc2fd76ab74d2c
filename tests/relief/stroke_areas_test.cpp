#include "relief/stroke_fields.h"

#include "support/strokes.h"

namespace relievo {
namespace {

using test::place_of, test::surface_of;

Stroke lasso_of(std::vector<Vec3> corners, const Vec3& direction, double radius = .1) {
  return {.radius = radius, .points = std::move(corners), .area = StrokeArea::lasso, .direction = direction};
}

// Returns the corners of a polygon on an ellipse in the plane at height z.
std::vector<Vec3> ellipse(double a, double b, double z = 0) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 60; ++i) {
    const double turn = 2 * std::numbers::pi * i / 60;
    corners.emplace_back(a * std::cos(turn), b * std::sin(turn), z);
  }
  return corners;
}

// Returns for each point of the surface whether it is in the area, and expects that no point is listed twice.
std::vector<std::uint8_t> members(const Surface& surface, const StrokePoints& area) {
  std::vector<std::uint8_t> is_in(surface.points.size(), 0);
  for (const Index i : area.points) EXPECT_EQ(is_in[i]++, 0);
  return is_in;
}

Mat3 turned(double degrees, const Vec3& axis) {
  return Eigen::AngleAxisd(degrees * std::numbers::pi / 180, axis).toRotationMatrix();
}

TEST(Lasso, HasWhatItEnclosesAndMeasuresFromItsEdge) {
  const Surface surface = surface_of(test::sheet(20000, 1, 0));
  const Stroke stroke = lasso_of({{-.5, -.3, 0}, {.5, -.3, 0}, {.5, .3, 0}, {-.5, .3, 0}}, {0, 0, 2});
  const StrokePoints area = points_of(surface, stroke);
  const std::vector<std::uint8_t> is_in = members(surface, area);
  for (Index i = 0; i < is_in.size(); ++i) {
    const Vec3 p = place_of(surface, i);
    EXPECT_EQ(is_in[i] != 0, std::abs(p.x()) < .5 && std::abs(p.y()) < .3) << p.transpose();
  }
  for (std::size_t k = 0; k < area.points.size(); ++k) {
    const Vec3 p = place_of(surface, area.points[k]);
    const double inside = std::min(.5 - std::abs(p.x()), .3 - std::abs(p.y()));
    EXPECT_NEAR(area.distances[k], std::max(0., .1 - inside), 1e-9);
  }
}

// A lasso selects the same points of the model in every view in which these points are visible.
TEST(Lasso, BelongsToTheModelInEveryView) {
  const Cloud ball = test::sphere(40000, 1);
  const Stroke stroke = lasso_of(ellipse(.5, .3, .85), Vec3::UnitZ());
  for (const double degrees : {0., 25., 50., -35.}) {
    View view{.R_view_model = turned(degrees, Vec3(1, 2, 0).normalized())};
    const Surface surface = surface_of(ball, view);
    const std::vector<std::uint8_t> is_in = members(surface, points_of(surface, stroke));
    std::size_t count = 0;
    for (Index i = 0; i < is_in.size(); ++i) {
      if (surface.boundary.is_boundary[i]) continue;
      const Vec3 p = place_of(surface, i);
      const double where = std::hypot(p.x() / .5, p.y() / .3);
      if (std::abs(where - 1) < .02) continue;
      EXPECT_EQ(is_in[i] != 0, where < 1 && p.z() > 0) << p.transpose();
      count += is_in[i];
    }
    EXPECT_GT(count, 500U) << degrees;
  }
}

TEST(Lasso, LeavesOutWhatIsFarBehind) {
  // The right half of the square lies 0.8 behind the left half. The lasso is 0.4 wide and has the depth of
  // the left half.
  const Surface surface = test::step(.8);
  const Stroke stroke = lasso_of({{-.2, -.2, .8}, {.2, -.2, .8}, {.2, .2, .8}, {-.2, .2, .8}}, Vec3::UnitZ());
  const StrokePoints area = points_of(surface, stroke);
  ASSERT_GT(area.points.size(), 300U);
  for (const Index i : area.points) EXPECT_GT(place_of(surface, i).z(), .5);
}

// Returns two planes that meet in a ridge along x = 0.
Surface roof(double slope) {
  return surface_of(test::height_field(
      40000, 1, [=](double x, double) { return -slope * std::abs(x); },
      [=](double x, double) { return Vec2(x < 0 ? slope : -slope, 0); }));
}

Stroke region_at(const Vec3& seed, double tolerance = 6) {
  return {.radius = .1, .points = {seed}, .area = StrokeArea::region, .tolerance = tolerance};
}

TEST(Region, GrowsUpToACreaseAndNoFurther) {
  const Surface surface = roof(.6);
  const std::vector<std::uint8_t> is_in = members(surface, points_of(surface, region_at({-.5, .2, -.3})));
  std::size_t missed = 0, far = 0;
  for (Index i = 0; i < is_in.size(); ++i) {
    const Vec3 p = place_of(surface, i);
    EXPECT_TRUE(p.x() < 0 || !is_in[i]) << p.transpose();
    const bool is_far_from_crease = p.x() < -.06 && p.cwiseAbs().head<2>().maxCoeff() < .95;
    far += is_far_from_crease;
    missed += is_far_from_crease && !is_in[i];
  }
  EXPECT_GT(far, 10000U);
  EXPECT_EQ(missed, 0U);
}

TEST(Region, CrossesACreaseThatIsWithinTheTolerance) {
  const Surface surface = roof(.6);
  const StrokePoints area = points_of(surface, region_at({-.5, .2, -.3}, 180));
  std::size_t right = 0;
  for (const Index i : area.points) right += place_of(surface, i).x() > .1;
  EXPECT_GT(right, 10000U);
}

TEST(Region, FadesFromItsEdge) {
  const Surface surface = roof(.6);
  const StrokePoints area = points_of(surface, region_at({-.5, .2, -.3}));
  double edge = -1;  // the largest x of the region
  for (const Index i : area.points) edge = std::max(edge, place_of(surface, i).x());
  for (std::size_t k = 0; k < area.points.size(); ++k) {
    const Vec3 p = place_of(surface, area.points[k]);
    if (std::abs(p.y()) > .7 || p.x() < -.7) continue;
    const double along = (edge - p.x()) * std::hypot(1, .6);
    EXPECT_NEAR(area.distances[k], std::clamp(.1 - along, 0., .1), .05);
    if (along > .16) EXPECT_EQ(area.distances[k], 0);
  }
}

TEST(Region, DoesNotCrossADepthJump) {
  const Surface surface = test::step(.25);
  const StrokePoints area = points_of(surface, region_at({-.5, 0, .25}, 180));
  ASSERT_GT(area.points.size(), 10000U);
  for (const Index i : area.points) EXPECT_LT(place_of(surface, i).x(), .02);
}

TEST(Region, IsEmptyWhereItsPointIsHidden) {
  const Surface front = surface_of(test::sphere(20000, 1));
  EXPECT_TRUE(points_of(front, region_at({0, 0, -1})).points.empty());
  EXPECT_FALSE(points_of(front, region_at({0, 0, 1})).points.empty());
}

}  // namespace
}  // namespace relievo
