#include "plate/plate_surface.h"

#include "support/plate_fronts.h"
#include "support/self_intersections.h"

namespace relievo {
namespace {

const Tool ball_end{Tool::Kind::ball, 2};

// Returns a block of 20 x 10 mm, 3 mm high. Its walls are as steep as the grid allows, and it has a pit at its centre.
HeightFieldMesh block() {
  return test::grid_front({40, 20, 160, 80}, [&](double x, double y) {
    const bool is_pit = std::abs(x - 20) < 1 && std::abs(y - 10) < 1;
    return x > 10 && x < 30 && y > 5 && y < 15 && !is_pit ? 3 : 0.;
  });
}

PlateOptions with_tool(PlateOptions options = {}) {
  options.tool = ball_end;
  return options;
}

TEST(ReachableSurface, IsReachedByItsToolAndNowhereLower) {
  for (const PlateOptions& options :
       {PlateOptions{5, 3}, PlateOptions{5, 3, Outline::circle, 5, RimOptions{3, 2, 1}}}) {
    const Solid before = test::plate_of(block(), options),
                after = test::plate_of(block(), with_tool(options));
    EXPECT_EQ(test::self_intersections(after), "");
    EXPECT_EQ(test::used_box(after).max.z(), test::used_box(before).max.z());
    const ToolReach was = measure_reach(before, ball_end), is = measure_reach(after, ball_end);
    EXPECT_GT(was.largest_residual_mm, .6);
    EXPECT_GT(is.reached_share, .995);
    EXPECT_LT(is.largest_residual_mm, 12 * is.mm_per_sample);  // the rise of a wall per sample
    double lowest = 0;
    for (std::size_t i = 0; i < is.heights_mm.pixels.size(); ++i)
      if (!std::isnan(is.heights_mm.pixels[i]))
        lowest = std::min(lowest, static_cast<double>(is.heights_mm.pixels[i] - was.heights_mm.pixels[i]));
    EXPECT_GT(lowest, -24 * is.mm_per_sample);
  }
}

// The tool, a ball end of radius 1 mm, touches a wall of slope 12 and the ground. Between these contacts,
// the surface must have the shape of the ball.
TEST(ReachableSurface, HasTheToolsShapeAtTheFootOfAWall) {
  const Solid solid = test::plate_of(block(), with_tool());
  const Vec2 foot(5 + 30, 5 + 10);
  const double from_foot = std::tan(std::atan(12) / 2);
  int found = 0;
  for (const Vec3& p : solid.points) {
    const double d = p.x() - foot.x();
    if (std::abs(p.y() - foot.y()) > 2 || d < 0 || d > from_foot || p.z() < 3) continue;
    EXPECT_NEAR(p.z() - 3, 1 - std::sqrt(1 - (from_foot - d) * (from_foot - d)), .02) << d;
    ++found;
  }
  EXPECT_GT(found, 50);
}

TEST(ReachableSurface, KeepsLevelGroundLevel) {
  const Solid solid = test::plate_of(block(), with_tool());
  for (const Vec3& p : solid.points)
    if (p.x() < 13 && p.x() > 0) EXPECT_TRUE(p.z() == 3 || p.z() == 0) << p.transpose();
}

TEST(ReachableSurface, OfWhatIsReachedIsTheSame) {
  const HeightFieldMesh front = test::flat_front({20, 10, 4, 2});
  const Solid solid = test::plate_of(front, with_tool());
  EXPECT_EQ(measure_reach(solid, ball_end).largest_residual_mm, 0);
  EXPECT_NEAR(volume_mm3(solid), volume_mm3(test::plate_of(front, {})), 1e-9);
}

// A flat end mill reaches all of a cone and of the ground around it, since it touches both from outside.
TEST(ReachableSurface, KeepsTheFootOfAConeThatAFlatToolReaches) {
  const HeightFieldMesh cone = test::pyramid_front(test::ellipse(90, 2, 2), 6);
  PlateOptions options;
  options.tool = Tool{Tool::Kind::flat, 2};
  const Solid before = test::plate_of(cone, {}), after = test::plate_of(cone, options);
  EXPECT_NEAR(volume_mm3(after), volume_mm3(before), 1e-4 * volume_mm3(before));
  for (const Vec3& p : cone.points) EXPECT_TRUE(test::has_corner_at(after, p.head<2>() + Vec2(7, 7), .01));
}

// Samples of the surface do not show a pit that consists of one point, so points are compared with their neighbours.
TEST(ReachableSurface, LeavesNoPitAtTheFootOfARim) {
  for (const Outline outline : {Outline::rectangle, Outline::circle}) {
    const Solid solid = test::plate_of(block(), with_tool({5, 3, outline, 5, RimOptions{3, 2, .5}}));
    std::vector<double> lowest_beside(solid.points.size(), std::numeric_limits<double>::infinity());
    for (std::size_t t = 0; t < solid.front_triangles; ++t)
      for (const Index i : solid.triangles[t])
        for (const Index j : solid.triangles[t])
          if (i != j) lowest_beside[i] = std::min(lowest_beside[i], solid.points[j].z());
    for (std::size_t i = 0; i < solid.points.size(); ++i)
      if (std::isfinite(lowest_beside[i])) EXPECT_LT(lowest_beside[i] - solid.points[i].z(), .05) << i;
  }
}

TEST(ReachableSurface, WithoutGroundIsLifted) {
  HeightFieldMesh front = block();
  front.is_relief.assign(front.triangles.size(), 1);
  const PlateOptions options{5, 3, Outline::none};
  const Solid before = test::plate_of(front, options), after = test::plate_of(front, with_tool(options));
  ASSERT_EQ(after.points.size(), before.points.size());
  for (std::size_t i = 0; i < before.points.size(); ++i) ASSERT_GE(after.points[i].z(), before.points[i].z());
  EXPECT_LT(measure_reach(after, ball_end).largest_residual_mm,
            .5 * measure_reach(before, ball_end).largest_residual_mm);
}

}  // namespace
}  // namespace relievo
