// Tests the points that the studio shows of a scan while the user turns the scan.
#include "studio/loaded_scan.h"

#include "relievo/scan/mesh.h"
#include "support/scene_parts.h"

namespace relievo {
namespace {

using app::studio::LoadedScan;
using test::model_of, test::wedge;

// Returns the box of the points, in view coordinates.
Box box_in(const Cloud& cloud, const View& view) {
  Box box;
  for (const Vec3& p : cloud.points) box.extend(view.R_view_model * p);
  return box;
}

// Expects that the points for turning a scene have about the same extent in the view plane as the points for
// its relief.
void expect_same_extent(const Scene& scene, const char* side) {
  const View view = parse_view(side).value();
  const LoadedScan scan({}, scene);
  const Cloud turned = *scan.all_sides(view).value(), seen = *scan.seen_from(view, 30'000., nullptr).value();
  EXPECT_GT(turned.size(), 10'000U);
  const Box found = box_in(turned, view), wanted = box_in(seen, view);
  const double tolerance = .03 * wanted.diagonal();
  EXPECT_LT((found.min - wanted.min).head<2>().norm(), tolerance) << side;
  EXPECT_LT((found.max - wanted.max).head<2>().norm(), tolerance) << side;
}

TEST(LoadedScan, TurnsAWholeMeshOfAScene) {
  const Pose turned{{0, 0, 30}};
  for (const char* side : {"front", "left"}) expect_same_extent({{model_of(wedge(), turned)}}, side);
}

TEST(LoadedScan, TurnsModelsSideBySideAsTheViewShowsThem) {
  const Cloud ball = test::sphere(20'000, 1);
  for (const char* side : {"front", "left", "top"})
    expect_same_extent({{model_of(ball), model_of(ball)}}, side);
  expect_same_extent({{model_of(ball), model_of(wedge())}}, "left");
}

TEST(LoadedScan, TurnsModelsWithTheirColoursAndOwnHeights) {
  Cloud red = test::sphere(20'000, 1);
  red.colours.assign(red.size(), {200, 0, 0});
  const Scene scene{{model_of(test::sphere(20'000, 1)), model_of(red, {.height = .5})}};
  const Cloud turned = *LoadedScan({}, scene).all_sides({}).value();
  ASSERT_EQ(turned.colours.size(), turned.size());
  ASSERT_EQ(turned.own_heights.size(), turned.size());
  for (std::size_t i = 0; i < turned.size(); ++i) {
    const bool is_red = turned.points[i].x() > 1.04;
    EXPECT_EQ(turned.colours[i], (is_red ? Colour{200, 0, 0} : Colour{255, 255, 255}));
    EXPECT_EQ(turned.own_heights[i], is_red ? .5F : 0.F);
  }
}

TEST(LoadedScan, RanksTheSidesOfAMeshAsViewAutoDoes) {
  const Scene scene{{model_of(wedge())}};
  const ViewGuess best = best_side(scene), first = LoadedScan({}, scene).ranked_sides().value().front();
  EXPECT_EQ(first.name, best.name);
  EXPECT_EQ(first.score, best.score);
}

}  // namespace
}  // namespace relievo
