// Tests reliefs on plates with rims, from the cloud to the solid.
#include "relievo/make_relief.h"
#include "relievo/scan/scan_file.h"
#include "support/results.h"
#include "support/shapes.h"

namespace relievo {
namespace {

MadeRelief made(const ReliefOptions& options) {
  const Cloud figure = test::joined(test::torus(10000, 1.5, .4), test::sphere(7000, .8));
  MadeRelief relief = value_of(make_relief(figure, options));
  EXPECT_EQ(check_solid(relief.solid), "");
  return relief;
}

ReliefOptions coin_options() {
  ReliefOptions options{{.width_mm = 20, .height_mm = .8, .margin_mm = 1, .rim_mm = 2}};
  options.outline = Outline::circle;
  return options;
}

// Returns the height above the ground of the highest corner of the plate's edge.
double rim_height(const MadeRelief& relief) {
  const Solid& solid = relief.solid;
  const Box box = Box::of(solid.points);
  double highest = 0;
  for (const Vec3& p : solid.points)
    if (p.x() < 1e-9 || p.x() > box.max.x() - 1e-9) highest = std::max(highest, p.z());
  return highest - 3 - relief.report.below_ground_mm;
}

TEST(MakePlates, ARimIsAsHighAsTheReliefIfItsBevelFits) {
  ReliefOptions options = coin_options();
  for (const double width : {2., .5}) {
    options.rim_mm = width;
    EXPECT_NEAR(rim_height(made(options)), .8, 1e-3) << width;
  }
  options.rim_mm = .15;  // the bevel's width is 0.3 times the height of the rim
  EXPECT_NEAR(rim_height(made(options)), .5, 1e-12);
  options.rim_bevel_mm = .1;
  EXPECT_NEAR(rim_height(made(options)), .8, 1e-3);
  options.rim_bevel_mm = {};
  options.rim_height_mm = 1.5;
  options.rim_mm = .5;
  EXPECT_NEAR(rim_height(made(options)), 1.5, 1e-12);
}

TEST(MakePlates, ADieIsTheCoinTurnedOver) {
  ReliefOptions options = coin_options();
  const Box coin = Box::of(made(options).solid.points);
  options.form = Form::die;
  const Box die = Box::of(made(options).solid.points);
  EXPECT_NEAR(die.size().z(), coin.size().z(), 1e-9);
  EXPECT_NEAR(die.size().x(), coin.size().x() + 2 * (2 + .3 * .8), 1e-3);
}

TEST(MakePlates, AWrapKeepsTheFlatPlateForHeightMaps) {
  ReliefOptions options{{.width_mm = 20, .height_mm = .8, .margin_mm = 1}};
  options.wrap = *parse_wrap("cylinder:diameter=30");
  const MadeRelief shell = made(options);
  ASSERT_TRUE(shell.report.wrap);
  const double width = Box::of(shell.flat.points).size().x(), pi = std::numbers::pi;
  EXPECT_EQ(shell.report.wrap->diameter_mm, 30);
  EXPECT_NEAR(shell.report.wrap->turn_deg, width / (30 * pi) * 360, 1e-9);
  EXPECT_NEAR(shell.report.wrap->mm_per_degree, 30 * pi / 360, 1e-12);
  EXPECT_EQ(check_solid(shell.flat), "");
  EXPECT_NEAR(shell.report.height_mm, .8, 1e-3);
  options.base = *parse_base("wave");
  EXPECT_TRUE(check(options).error().message().starts_with("wrap: expected either base or wrap"));
}

TEST(MakePlates, ABaseLeavesTheReliefsHeightAndADieFitsIt) {
  ReliefOptions options = coin_options();
  options.base = *parse_base("dome:height=1.5");
  const MadeRelief coin = made(options);
  EXPECT_NEAR(coin.report.height_mm, .8, 1e-3);
  options.form = Form::die;
  const MadeRelief die = made(options);
  EXPECT_NEAR(die.report.height_mm, .8, 1e-3);
  EXPECT_GT(Box::of(die.solid.points).size().z(), 3 + 1.5);
  options.form = Form::lithophane;
  EXPECT_TRUE(check(options).error().message().starts_with("base: expected a plane for a lithophane"));
}

}  // namespace
}  // namespace relievo
