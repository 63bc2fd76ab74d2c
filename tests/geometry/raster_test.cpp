#include "geometry/raster.h"

#include <gtest/gtest.h>

#include "geometry/image_filters.h"
#include "support/shapes.h"

namespace relievo {
namespace {

// A rectangle that covers the whole picture. It is divided into `cells` x `cells` quadrangles with jittered
// corners, each of two triangles. The coordinates of corners are rounded to multiples of `round`. If
// `round` is 0.5, centres of pixels lie on edges and corners.
struct Sheet {
  std::vector<Triangle> triangles;
  RasterInput scene;

  Sheet(int width, int height, int cells, double round) {
    test::Random random(1);
    const auto place = [&](int i, double size) {
      const double jitter = i == 0 || i == cells ? 0 : random.uniform() * 0.48 - 0.24;
      const double at = (i + jitter) * size / cells;
      return i == cells ? size : std::round(at / round) * round;
    };
    for (int j = 0; j <= cells; ++j)
      for (int i = 0; i <= cells; ++i)
        scene.points.emplace_back(place(i, width), place(j, height), random.uniform());
    const auto at = [&](int i, int j) { return static_cast<Index>(j * (cells + 1) + i); };
    for (int j = 0; j < cells; ++j) {
      for (int i = 0; i < cells; ++i) {
        triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
        triangles.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
      }
    }
    scene.triangles = triangles;
    scene.width = width;
    scene.height = height;
  }
};

std::vector<Fragment> draw_all(const RasterInput& scene, int band_rows) {
  const Rasterizer raster(scene, band_rows);
  std::vector<Fragment> fragments;
  for (std::size_t b = 0; b < raster.bands(); ++b) {
    const RowBand band = raster.draw(b);
    EXPECT_EQ(static_cast<std::size_t>(band.first_row) * static_cast<std::size_t>(scene.width),
              fragments.size());
    fragments.insert(fragments.end(), band.fragments.pixels.begin(), band.fragments.pixels.end());
  }
  return fragments;
}

TEST(Rasterizer, EveryCentreBelongsToExactlyOneTriangle) {
  for (const double round : {1e-9, 0.5}) {
    for (const int cells : {1, 7, 40}) {
      const Sheet sheet(64, 48, cells, round);
      std::vector<int> count(64 * 48, 0);
      for (const Triangle& t : sheet.triangles) {
        RasterInput one = sheet.scene;
        one.triangles = std::span(&t, 1);
        const std::vector<Fragment> fragments = draw_all(one, 48);
        for (std::size_t i = 0; i < fragments.size(); ++i) count[i] += fragments[i].triangle == 0;
      }
      EXPECT_EQ(std::ranges::count(count, 1), 64 * 48) << cells << " cells rounded to " << round;
    }
  }
}

TEST(Rasterizer, FindsTheTriangleThatHoldsTheCentre) {
  const Sheet sheet(200, 150, 20, 1e-9);
  const std::vector<Fragment> fragments = draw_all(sheet.scene, 150);
  for (int y = 0; y < 150; ++y) {
    for (int x = 0; x < 200; ++x) {
      const Fragment& fragment = fragments[static_cast<std::size_t>(y * 200 + x)];
      ASSERT_NE(fragment.triangle, no_index);
      const Vec3f weights = corner_weights(sheet.scene, fragment.triangle, x + .5, y + .5);
      const auto& [a, b, c] = sheet.triangles[fragment.triangle];
      const auto& points = sheet.scene.points;
      const Vec3 place = weights[0] * points[a] + weights[1] * points[b] + weights[2] * points[c];
      // The rasterizer rounds corners to 1/256 pixel. No triangle is thinner than a pixel, so this
      // rounding moves positions by less than 0.01.
      EXPECT_LT((place.head<2>() - Vec2(x + .5, y + .5)).norm(), 0.01);
      EXPECT_NEAR(fragment.z, place.z(), 0.01);
    }
  }
}

TEST(Rasterizer, HeightsOfAPlaneAreExact) {
  Sheet sheet(300, 200, 13, 1e-9);
  const auto plane = [](double x, double y) { return 3 + x / 7 - y / 11; };
  for (Vec3& p : sheet.scene.points) p.z() = plane(p.x(), p.y());
  const std::vector<Fragment> fragments = draw_all(sheet.scene, 64);
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 300; ++x)
      ASSERT_NEAR(fragments[static_cast<std::size_t>(y * 300 + x)].z, plane(x + .5, y + .5), 1e-5);
}

TEST(Rasterizer, BandsDoNotChangeThePicture) {
  const Sheet sheet(100, 75, 9, 1e-9);
  const std::vector<Fragment> whole = draw_all(sheet.scene, 75), parts = draw_all(sheet.scene, 7);
  ASSERT_EQ(whole.size(), parts.size());
  for (std::size_t i = 0; i < whole.size(); ++i) {
    EXPECT_EQ(whole[i].triangle, parts[i].triangle);
    EXPECT_EQ(whole[i].z, parts[i].z);
  }
}

TEST(Rasterizer, TheNearestIsSeenAndBackFacesAreNot) {
  RasterInput scene{
      {{0, 0, 1}, {0, 20, 1}, {20, 0, 1}, {0, 0, 2}, {0, 10, 2}, {10, 0, 2}, {20, 20, 9}}, {}, 20, 20};
  const std::vector<Triangle> triangles{{0, 1, 2}, {3, 4, 5}, {0, 1, 2}, {1, 6, 2}, {1, 2, 6}};
  scene.triangles = triangles;
  const std::vector<Fragment> fragments = draw_all(scene, 6);
  EXPECT_EQ(fragments[0].triangle, 1U);             // nearer than triangle 0
  EXPECT_EQ(fragments[12].triangle, 0U);            // as near as triangle 2, but first in order
  EXPECT_EQ(fragments[19 * 20 + 19].triangle, 3U);  // triangle 4 covers this pixel, too, but faces away
}

TEST(Rasterizer, ASliverDoesNotSpike) {
  const RasterInput scene{{{0, 10, 0}, {100, 10.004, 5}, {50, 10.001, 100}}, {}, 100, 20};
  RasterInput drawn = scene;
  const std::vector<Triangle> triangles{{0, 1, 2}, {0, 2, 1}};
  drawn.triangles = triangles;
  for (const Fragment& fragment : draw_all(drawn, 20)) {
    if (fragment.triangle == no_index) continue;
    EXPECT_GE(fragment.z, 0);
    EXPECT_LE(fragment.z, 100);
  }
}

TEST(CornerWeights, ReproduceThePlaceAndStayPositiveOutside) {
  RasterInput scene{{{0, 0, 0}, {0, 10, 0}, {10, 0, 0}}, {}, 10, 10};
  const std::vector<Triangle> triangles{{0, 1, 2}, {0, 0, 1}};
  scene.triangles = triangles;
  const Vec3f weights = corner_weights(scene, 0, 2, 3);
  EXPECT_LT((weights - Vec3f(.5F, .3F, .2F)).norm(), 1e-6);
  for (const double x : {-5.0, 30.0}) EXPECT_GE(corner_weights(scene, 0, x, 2).minCoeff(), 0);
  EXPECT_NEAR(corner_weights(scene, 0, 30, 20).sum(), 1, 1e-6);
  EXPECT_NEAR(corner_weights(scene, 1, 3, 3).sum(), 1, 1e-6);  // a triangle without area
}

// Computes blur() directly by its definition in image_filters.h.
std::vector<float> slow_blur(std::vector<float> values, int width, int radius) {
  const int height = static_cast<int>(values.size()) / width;
  const auto at = [&](const std::vector<float>& v, int x, int y) {
    x = std::clamp(x, 0, width - 1), y = std::clamp(y, 0, height - 1);
    return v[static_cast<std::size_t>(y * width + x)];
  };
  for (int pass = 0; pass < 2; ++pass) {
    const std::vector<float> before = values;
    for (int i = 0; i < width * height; ++i) {
      double sum = 0;
      for (int dy = -radius; dy <= radius; ++dy)
        for (int dx = -radius; dx <= radius; ++dx) sum += at(before, i % width + dx, i / width + dy);
      values[static_cast<std::size_t>(i)] = static_cast<float>(sum / ((2 * radius + 1) * (2 * radius + 1)));
    }
  }
  return values;
}

TEST(Blur, IsTheAverageOverBoxesTwice) {
  test::Random random(1);
  for (const auto& [width, height, radius] : {std::array{37, 29, 3}, {5, 40, 9}, {1, 1, 2}, {33, 1, 1}}) {
    Image<float> image = filled_image(width, height, 0.F);
    for (float& v : image.pixels) v = static_cast<float>(random.uniform());
    const std::vector<float> expected = slow_blur(image.pixels, width, radius);
    blur(image, radius);
    for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(image.pixels[i], expected[i], 1e-5) << i;
  }
}

}  // namespace
}  // namespace relievo
