#include "relievo/plate/forms.h"
#include "core/quantile.h"
#include "relievo/io/read.h"
#include "relievo/io/write.h"

#include <vector>

#include "relievo/make_relief.h"
#include "relievo/scan/depth_image.h"
#include "relievo/scan/scan_file.h"
#include "relievo/scan/surface.h"
#include "support/results.h"
#include "support/shapes.h"

namespace relievo {
namespace {

// Returns an asymmetric cloud: a ball with a smaller ball on its upper right.
Cloud balls() {
  Cloud cloud = test::sphere(12000, 1);
  const Cloud small = test::sphere(6000, .5, 9);
  for (std::size_t i = 0; i < small.size(); ++i)
    test::add(cloud, small.points[i] + Vec3(1.2, .8, .2), small.normals[i].cast<double>());
  return cloud;
}

MadeRelief made(Form form) {
  ReliefOptions options{{.height_mm = 4}};
  options.form = form;
  MadeRelief relief = value_of(make_relief(balls(), options));
  EXPECT_EQ(check_solid(relief.solid), "");
  return relief;
}

// Returns the lithophane of a cloud. It is 20 mm wide, and its thickness varies by 4 mm.
HeightFieldMesh lithophane_of(const Cloud& cloud) {
  return lithophane(*find_surface(cloud, *parse_view("front")), 10, 4);
}

// Returns a ball whose colour at each point p is grey(p).
template <typename F>
Cloud grey_ball(F grey) {
  Cloud cloud = test::sphere(20000, 1);
  for (const Vec3& p : cloud.points) {
    const auto shade = static_cast<std::uint8_t>(grey(p));
    cloud.colours.push_back({shade, shade, shade});
  }
  return cloud;
}

// Returns a grey picture as a cloud of flat points. Its values are grey(column, row).
template <typename F>
Cloud picture(int width, int height, F grey) {
  DepthImage image{filled_image(width, height, 0.F), 1, "test"};
  for (int r = 0; r < height; ++r)
    for (int c = 0; c < width; ++c) image.values.at(c, r) = static_cast<float>(grey(c, r));
  return value_of(picture_cloud(image, {})).cloud;
}

// Returns the median height of the points within a circle.
double height_around(const HeightFieldMesh& front, const Vec2& centre, double radius) {
  std::vector<double> heights;
  for (const Vec3& p : front.points)
    if ((p.head<2>() - centre).norm() < radius) heights.push_back(p.z());
  EXPECT_GT(heights.size(), 4U);
  return median(heights);
}

TEST(Forms, AMirrorSwapsLeftAndRight) {
  const MadeRelief relief = made(Form::relief), mirror = made(Form::mirror);
  const double width = Box::of(relief.solid.points).max.x();
  ASSERT_EQ(relief.solid.points.size(), mirror.solid.points.size());
  for (std::size_t i = 0; i < relief.solid.points.size() - 8; i += 97) {
    EXPECT_NEAR(mirror.solid.points[i].x(), width - relief.solid.points[i].x(), 1e-9);
    EXPECT_NEAR(mirror.solid.points[i].z(), relief.solid.points[i].z(), 1e-5);
  }
}

TEST(Forms, TheReliefFitsIntoItsDie) {
  const MadeRelief relief = made(Form::relief), die = made(Form::die);
  const double width = Box::of(relief.solid.points).max.x();
  // If the die is rotated by 180 degrees about the y axis, it fits on the relief without a gap.
  const double sum = relief.solid.points[0].z() + die.solid.points[0].z();
  for (std::size_t i = 0; i < relief.solid.points.size() - 8; i += 89) {
    EXPECT_NEAR(die.solid.points[i].x(), width - relief.solid.points[i].x(), 1e-9);
    EXPECT_NEAR(die.solid.points[i].z() + relief.solid.points[i].z(), sum, 1e-5);
  }
  EXPECT_NEAR(die.report.height_mm, 4, .01);
}

TEST(Forms, ALithophaneIsThickWhereTheModelIsDark) {
  const MadeRelief it = made(Form::lithophane);
  const Box box = Box::of(it.solid.points);
  EXPECT_NEAR(box.max.z(), .8 + 4, 1e-6);  // .8 mm, through which light passes, and the relief of 4 mm
  EXPECT_NEAR(it.report.height_mm, 4, 1e-12);
  // The lamp is at the upper left. So the plate is thinner at the ball's upper left than at its lower right.
  const HeightFieldMesh front = lithophane_of(test::sphere(20000, 1));
  EXPECT_LT(height_around(front, {-3, 3}, 1), .1);
  EXPECT_GT(height_around(front, {5, -5}, 1), 1);
  for (const Index i : front.hull) EXPECT_EQ(front.points[i].z(), 4);
}

TEST(Forms, ColoursDarkenALithophane) {
  const HeightFieldMesh front = lithophane_of(grey_ball([](const Vec3& p) { return p.y() > 0 ? 255 : 200; }));
  // Grey 200 must transmit 57.8 % of the light that white transmits. A thickness of 4 mm weakens light to a
  // tenth, so the plate must be thicker by 4 ln(1 / 0.578) / ln 10 = 0.95 mm there.
  EXPECT_NEAR(height_around(front, {-1, -.5}, .4) - height_around(front, {-1, .5}, .4), .95, .15);
}

TEST(Forms, AHighlightDarkensNothingElseOfALithophane) {
  const auto middle = [](int highlight) {
    const Cloud ball =
        grey_ball([&](const Vec3& p) { return (p.head<2>() - Vec2(-.3, .3)).norm() < .05 ? highlight : 60; });
    return height_around(lithophane_of(ball), {0, 0}, 5);
  };
  EXPECT_LT(middle(60), 1);
  EXPECT_NEAR(middle(255), middle(60), .05);
}

// Two of the ball's three shades are darker than a tenth of white. Still, their heights must differ.
TEST(Forms, ALithophaneShowsWhatIsDarkerThanATenth) {
  const HeightFieldMesh front = lithophane_of(grey_ball([](const Vec3& p) {
    return p.y() > .3 ? 255 : p.y() > -.3 ? 60 : 30;
  }));
  const double light = height_around(front, {-1, 5}, 1), dark = height_around(front, {-1, 0}, 1),
               darkest = height_around(front, {-1, -5}, 1);
  EXPECT_LT(light + 1, dark);
  EXPECT_LT(dark + .5, darkest);
}

TEST(Forms, ColoursReachThePlate) {
  Cloud cloud = test::sphere(12000, 1);
  cloud.colours.assign(cloud.size(), Colour{10, 20, 30});
  const auto relief = value_of(make_relief(cloud, ReliefOptions{}));
  ASSERT_EQ(relief.solid.colours.size(), relief.solid.points.size());
  EXPECT_EQ(relief.solid.colours[0], (Colour{10, 20, 30}));
  const auto file = write_ply(relief.solid);
  const auto back = value_of(read_cloud(file, "relief.ply"));
  EXPECT_EQ(back.cloud.colours, relief.solid.colours);
  EXPECT_EQ(back.mesh.triangles.size(), relief.solid.triangles.size());
}

// Every pixel of a picture counts. No highlights are cut, the darkest tenth does not become black, and no
// shading is added.
TEST(Lithophane, OfAPictureIsLinearInEveryPixel) {
  constexpr int width = 40, height = 30;
  const auto grey = [](int c, int r) { return (37 * c + 101 * r) % 256; };
  const HeightFieldMesh front = lithophane_of(picture(width, height, grey));
  const double pixel_mm = 10;
  std::size_t pixels = 0;
  for (const Vec3& p : front.points) {
    const double c = p.x() / pixel_mm + width / 2. - .5, r = height / 2. - .5 - p.y() / pixel_mm;
    const bool is_frame = std::abs(c - std::round(c)) > .1 || std::abs(r - std::round(r)) > .1 || c < -.1 ||
                          r < -.1 || c > width - .9 || r > height - .9;
    const int x = static_cast<int>(std::lround(c)), y = static_cast<int>(std::lround(r));
    EXPECT_NEAR(p.z(), is_frame ? 4 : 4 * (1 - grey(x, y) / 255.), 4.01 / 255) << c << ", " << r;
    pixels += !is_frame;
  }
  EXPECT_EQ(pixels, std::size_t{width * height});
  EXPECT_TRUE(front.colours.empty());
}

}  // namespace
}  // namespace relievo
