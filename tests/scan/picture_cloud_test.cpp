#include "relievo/scan/depth_image.h"

#include <cmath>

#include "support/results.h"

namespace relievo {
namespace {

constexpr int columns = 12, rows = 8;

DepthImage ramp() {
  DepthImage image{filled_image(columns, rows, 0.F), 1, "test"};
  for (int i = 0; i < columns * rows; ++i)
    image.values[static_cast<std::size_t>(i)] = static_cast<float>(100 + i);
  return image;
}

TEST(PictureCloud, HasAFlatPointPerPixelAndAFrame) {
  const DepthCloud made = value_of(picture_cloud(ramp(), {}));
  const Cloud& cloud = made.cloud;
  ASSERT_EQ(cloud.size(), std::size_t{columns * rows + 2 * (columns + rows) + 4});
  EXPECT_TRUE(cloud.is_height_field);
  const Box box = bounds(cloud);
  EXPECT_EQ(box.size(), Vec3(columns, rows, 0));
  for (std::size_t i = 0; i < std::size_t{columns * rows}; ++i) {
    const int c = static_cast<int>(i) % columns, r = static_cast<int>(i) / columns;
    EXPECT_EQ(cloud.points[i], Vec3(c + .5 - columns / 2., rows / 2. - r - .5, 0));
    EXPECT_EQ(cloud.colours[i][1], std::lround(255 * static_cast<double>(i) / (columns * rows - 1)));
    EXPECT_EQ(cloud.normals[i], Vec3f(0, 0, 1));
  }
}

TEST(PictureCloud, MissingPixelsAreWhite) {
  DepthImage image = ramp();
  image.values[0] = std::nanf("");
  const DepthCloud made = value_of(picture_cloud(image, {}));
  EXPECT_EQ(made.missing, 1U);
  EXPECT_EQ(made.cloud.colours[0], (Colour{255, 255, 255}));
  EXPECT_EQ(made.cloud.colours[1], (Colour{0, 0, 0}));
}

TEST(PictureCloud, IsStretchedByTheSizeOfPixels) {
  DepthImage image = ramp();
  image.pixel_size = Vec2(1, 2);
  EXPECT_EQ(bounds(value_of(picture_cloud(image, {})).cloud).size(), Vec3(columns / 2., rows, 0));
}

TEST(PictureCloud, IsReducedToMeans) {
  DepthImage image{filled_image(100, 100, 1.F), 1, "test"};
  for (std::size_t i = 0; i < image.values.size(); ++i)
    image.values[i] = i % 100 < 50 ? static_cast<float>(i % 2) : 2;
  DepthOptions options{.points = 2500};
  const DepthCloud made = value_of(picture_cloud(image, options));
  EXPECT_EQ(made.reduction, 2);
  EXPECT_EQ(bounds(made.cloud).size(), Vec3(50, 50, 0));
  EXPECT_EQ(made.cloud.colours[0], (Colour{0, 0, 0}));
  EXPECT_EQ(made.cloud.colours[49], (Colour{255, 255, 255}));
}

TEST(PictureCloud, NeedsTwoBrightnesses) {
  EXPECT_EQ(picture_cloud({filled_image(9, 9, 1.F), 1, "test"}, {}).error().message(),
            "expected a picture with bright and dark pixels, found one brightness");
}

// The pixels are half as wide as high. A round hill that is stored in such pixels must become round again.
TEST(DepthCloud, IsStretchedByTheSizeOfPixels) {
  DepthImage image{filled_image(80, 40, 0.F), 0, "test"};
  for (int r = 0; r < 40; ++r)
    for (int c = 0; c < 80; ++c)
      image.values.at(c, r) =
          static_cast<float>(std::exp(-std::pow((c - 39.5) / 30, 2) - std::pow((r - 19.5) / 15, 2)));
  image.pixel_size = Vec2(10, 20);
  DepthOptions options{.values = DepthValues::height, .background = Removal::keep};
  const Cloud cloud = value_of(depth_cloud(image, options)).cloud;
  EXPECT_EQ(bounds(cloud).size().x(), 79 / 2.);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Vec3f& n = cloud.normals[i];
    EXPECT_NEAR(n.norm(), 1, 1e-6);
    const Vec3& p = cloud.points[i];
    const double radius = p.head<2>().norm();
    if (radius < 3 || radius > 15) continue;
    EXPECT_GT(n.head<2>().cast<double>().normalized().dot(p.head<2>().normalized()), .99) << p.transpose();
  }
}

}  // namespace
}  // namespace relievo
