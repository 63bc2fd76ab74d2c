#include "relievo/plate/forms.h"
#include "core/quantile.h"
#include "relievo/io/read.h"
#include "relievo/io/write.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "relievo/make_relief.h"
#include "relievo/scan/scan_file.h"
#include "relievo/scan/surface.h"
#include "support/shapes.h"

namespace relievo {
namespace {

// Not symmetric: a ball with a smaller one at its upper right.
Cloud balls() {
  Cloud cloud = test::sphere(12000, 1);
  const Cloud small = test::sphere(6000, .5, 9);
  for (std::size_t i = 0; i < small.size(); ++i)
    test::add(cloud, small.points[i] + Vec3(1.2, .8, .2), small.normals[i].cast<double>());
  return cloud;
}

MadeRelief made(Form form, std::optional<double> tolerance = {}) {
  ReliefOptions options;
  options.form = form;
  options.height_mm = 4;
  options.tolerance_mm = tolerance;
  auto relief = make_relief(balls(), options);
  EXPECT_TRUE(relief) << relief.error().message();
  EXPECT_EQ(check_solid(relief->solid), "");
  return std::move(*relief);
}

Box box_of(const Solid& solid) {
  return Box::of(solid.points);
}

TEST(Forms, AreToldByTheirNames) {
  EXPECT_EQ(*parse_form("relief"), Form::relief);
  EXPECT_EQ(*parse_form("lithophane"), Form::lithophane);
  EXPECT_EQ(parse_form("coin").error().message(),
            "form: expected one of relief, mirror, die or lithophane, found 'coin'");
}

TEST(Forms, AMirrorSwapsLeftAndRight) {
  const MadeRelief relief = made(Form::relief), mirror = made(Form::mirror);
  const double width = box_of(relief.solid).max.x();
  ASSERT_EQ(relief.solid.points.size(), mirror.solid.points.size());
  for (std::size_t i = 0; i < relief.solid.points.size() - 8; i += 97) {
    EXPECT_NEAR(mirror.solid.points[i].x(), width - relief.solid.points[i].x(), 1e-9);
    EXPECT_NEAR(mirror.solid.points[i].z(), relief.solid.points[i].z(), 1e-5);
  }
}

TEST(Forms, TheReliefFitsIntoItsDie) {
  const MadeRelief relief = made(Form::relief), die = made(Form::die);
  const double width = box_of(relief.solid).max.x();
  // Face to face: the die turned about the y axis meets the relief with no gap.
  const double sum = relief.solid.points[0].z() + die.solid.points[0].z();
  for (std::size_t i = 0; i < relief.solid.points.size() - 8; i += 89) {
    EXPECT_NEAR(die.solid.points[i].x(), width - relief.solid.points[i].x(), 1e-9);
    EXPECT_NEAR(die.solid.points[i].z() + relief.solid.points[i].z(), sum, 1e-5);
  }
  EXPECT_NEAR(die.report.height_mm, 4, .01);
}

TEST(Forms, TheReportTellsWhereTheScanLies) {
  const Cloud cloud = balls();
  for (const Form form : {Form::relief, Form::mirror, Form::die}) {
    const MadeRelief it = made(form);
    // Points of the scan whose normals face the viewer come to lie over points of the front.
    const auto& [rotation, scale, offset] = std::tie(it.report.rotation, it.report.scale, it.report.offset);
    double nearest_sum = 0;
    int count = 0;
    for (std::size_t i = 0; i < cloud.size(); i += 100) {
      if (cloud.normals[i].z() < .8F) continue;
      const Vec3 p = scale * (rotation * cloud.points[i]) + offset;
      double nearest = 1e9;
      for (std::size_t k = 0; k < it.solid.points.size(); k += 3)
        nearest = std::min(nearest, (it.solid.points[k] - p).head<2>().norm());
      nearest_sum += nearest, ++count;
    }
    ASSERT_GT(count, 0);
    EXPECT_LT(nearest_sum / count, 1.5)
        << name_in(form_choices, form);  // hidden ones lie between their neighbours
  }
}

TEST(Forms, ALithophaneIsThickWhereTheModelIsDark) {
  const MadeRelief it = made(Form::lithophane);
  const Box box = box_of(it.solid);
  EXPECT_NEAR(box.max.z(), .8 + 4, 1e-6);  // the plate is thin for the light
  EXPECT_NEAR(it.report.height_mm, 4, 1e-12);
  // The lamp is at the upper left: over the ball's upper left the plate is thinner than over its lower right.
  Surface surface = *find_surface(test::sphere(20000, 1), *parse_view("front"));
  const HeightFieldMesh front = lithophane(surface, 10, 4);
  double lit = 0, dark = 0;
  int lit_count = 0, dark_count = 0;
  for (const Vec3& p : front.points) {
    if ((p.head<2>() - Vec2(-3, 3)).norm() < 1) lit += p.z(), ++lit_count;
    if ((p.head<2>() - Vec2(5, -5)).norm() < 1) dark += p.z(), ++dark_count;
  }
  ASSERT_GT(lit_count, 10);
  ASSERT_GT(dark_count, 10);
  EXPECT_LT(lit / lit_count, .1);
  EXPECT_GT(dark / dark_count, 1);
  for (const Index i : front.hull) EXPECT_EQ(front.points[i].z(), 4);
}

TEST(Forms, ColoursDarkenALithophane) {
  Cloud cloud = test::sphere(20000, 1);
  for (const Vec3& p : cloud.points) {
    const std::uint8_t grey = p.y() > 0 ? 255 : 200;
    cloud.colours.push_back({grey, grey, grey});
  }
  const Surface surface = *find_surface(cloud, *parse_view("front"));
  const HeightFieldMesh front = lithophane(surface, 10, 4);
  double bright = 0, dark = 0;
  int bright_count = 0, dark_count = 0;
  for (const Vec3& p : front.points) {
    if ((p.head<2>() - Vec2(-1, .5)).norm() < .4) bright += p.z(), ++bright_count;
    if ((p.head<2>() - Vec2(-1, -.5)).norm() < .4) dark += p.z(), ++dark_count;
  }
  // Grey 200 passes 57.8 % of the light: 4 ln(1 / .578) / ln 10 = .95 mm more.
  EXPECT_NEAR(dark / dark_count - bright / bright_count, .95, .15);
}

// Returns the middle height of the points in the middle of a ball that is dark but for a highlight of that grey.
double middle_of_dark_ball(std::uint8_t highlight) {
  Cloud cloud = test::sphere(20000, 1);
  for (const Vec3& p : cloud.points) {
    const bool is_light = (p.head<2>() - Vec2(-.3, .3)).norm() < .05;
    const std::uint8_t grey = is_light ? highlight : 60;
    cloud.colours.push_back({grey, grey, grey});
  }
  std::vector<double> heights;
  for (const Vec3& p : lithophane(*find_surface(cloud, *parse_view("front")), 10, 4).points)
    if (p.head<2>().norm() < 5) heights.push_back(p.z());
  return median(heights);
}

TEST(Forms, AHighlightDarkensNothingElseOfALithophane) {
  const double plain = middle_of_dark_ball(60);
  EXPECT_LT(plain, 1);
  EXPECT_NEAR(middle_of_dark_ball(255), plain, .05);
}

TEST(Forms, ALithophaneShowsWhatIsDarkerThanATenth) {
  Cloud cloud = test::sphere(20000, 1);  // in three greys, of which two are darker than a tenth
  for (const Vec3& p : cloud.points) {
    const std::uint8_t grey = p.y() > .3 ? 255 : p.y() > -.3 ? 60 : 30;
    cloud.colours.push_back({grey, grey, grey});
  }
  std::array<std::vector<double>, 3> heights;
  for (const Vec3& p : lithophane(*find_surface(cloud, *parse_view("front")), 10, 4).points)
    for (std::size_t i = 0; i < 3; ++i)
      if ((p.head<2>() - Vec2(-1, 5 - 5 * static_cast<double>(i))).norm() < 1) heights[i].push_back(p.z());
  const double light = median(heights[0]), dark = median(heights[1]), darkest = median(heights[2]);
  EXPECT_LT(light + 1, dark);
  EXPECT_LT(dark + .5, darkest);
}

TEST(Forms, AToleranceMakesTheFrontSimplerAndTellsItsError) {
  const MadeRelief full = made(Form::relief), simple = made(Form::relief, .02);
  EXPECT_LT(simple.solid.triangles.size(), full.solid.triangles.size());
  ASSERT_TRUE(simple.report.simplification_error_mm);
  EXPECT_LE(*simple.report.simplification_error_mm, .02);
  EXPECT_FALSE(full.report.simplification_error_mm);
  EXPECT_NEAR(box_of(simple.solid).max.z(), box_of(full.solid).max.z(), .02);
}

TEST(Forms, ColoursReachThePlate) {
  Cloud cloud = test::sphere(12000, 1);
  cloud.colours.assign(cloud.size(), Colour{10, 20, 30});
  const auto relief = make_relief(cloud, ReliefOptions{});
  ASSERT_TRUE(relief);
  ASSERT_EQ(relief->solid.colours.size(), relief->solid.points.size());
  EXPECT_EQ(relief->solid.colours[0], (Colour{10, 20, 30}));
  const auto file = write_ply(relief->solid);
  const auto back = read_cloud(file, "relief.ply");
  ASSERT_TRUE(back);
  EXPECT_EQ(back->cloud.colours, relief->solid.colours);
  EXPECT_EQ(back->mesh.triangles.size(), relief->solid.triangles.size());
}

}  // namespace
}  // namespace relievo
