#include "relievo/picture/render.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "relievo/core/parallel.h"
#include "support/shapes.h"

namespace relievo {
namespace {

// A half ball: 2 wide and high in the plane.
std::shared_ptr<const ReliefModel> ball() {
  static const auto model = std::make_shared<const ReliefModel>(
      *ReliefModel::prepare(*find_surface(test::sphere(20000, 1), View{})));
  return model;
}

// A relief of the ball, given by a function of the place.
struct Field {
  std::vector<float> heights;
  std::vector<Vec3f> normals;
  Shown shown() const { return {heights, normals}; }
};

template <typename F>
Field field(F f, const Vec3f& normal = Vec3f::UnitZ()) {
  Field made;
  for (const Vec3& p : ball()->surface().points) made.heights.push_back(static_cast<float>(f(p)));
  made.normals.assign(made.heights.size(), normal);
  return made;
}

Field bumps() {
  Field made = field([](const Vec3& p) { return .1 * std::sin(9 * p.x()) * std::sin(7 * p.y()); });
  for (std::size_t i = 0; i < made.normals.size(); ++i) made.normals[i] = ball()->surface().normals[i];
  return made;
}

RenderOptions small() {
  RenderOptions options;
  options.width = 240;
  options.height = 200;
  options.mm_per_unit = 50;
  return options;
}

Picture picture(const Field& field, const RenderOptions& options) {
  FrameRenderer renderer(ball());
  Picture made;
  renderer.render(field.shown(), options, made);
  return made;
}

double mean_difference(const Picture& a, const Picture& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.rgba.size(); ++i) sum += std::abs(int{a.rgba[i]} - int{b.rgba[i]});
  return sum / static_cast<double>(a.rgba.size());
}

std::size_t opaque_pixels(const Picture& picture) {
  std::size_t count = 0;
  for (std::size_t i = 3; i < picture.rgba.size(); i += 4) count += picture.rgba[i] == 255;
  return count;
}

// Red at a pixel.
int red(const Picture& picture, int column, int row) {
  return picture.rgba[4 * static_cast<std::size_t>(row * picture.width + column)];
}

TEST(Render, CoversThePlate) {
  for (const bool is_fine : {false, true}) {
    RenderOptions options = small();
    options.is_fine = is_fine;
    const Picture made = picture(bumps(), options);
    ASSERT_EQ(made.rgba.size(), 240U * 200U * 4U);
    const double side = (2 * 50 + 2 * options.margin_mm) * made.pixels_per_mm;
    EXPECT_NEAR(static_cast<double>(opaque_pixels(made)) / (side * side), 1, .02);
  }
}

TEST(Render, AFlatReliefIsEven) {
  for (const auto material : {Material::plaster, Material::silver, Material::bronze, Material::porcelain}) {
    RenderOptions options = small();
    options.material = material;
    const Picture made = picture(field([](const Vec3&) { return 0; }), options);
    for (int column = 60; column < 180; column += 7)
      for (int row = 40; row < 160; row += 7) ASSERT_EQ(red(made, column, row), red(made, 120, 100));
  }
}

TEST(Render, IsBrighterWhereItFacesTheLamp) {
  RenderOptions options = small();
  const auto brightness = [&](const Vec3f& normal) {
    return red(picture(field([](const Vec3&) { return 0; }, normal.normalized()), options), 120, 100);
  };
  options.light = Vec3f(-1, 0, 1);
  const int towards = brightness({-.3F, 0, 1}), level = brightness({0, 0, 1}), away = brightness({.3F, 0, 1});
  EXPECT_GT(towards, level);
  EXPECT_GT(level, away);
}

TEST(Render, KeepsNothingOfEarlierPictures) {
  FrameRenderer used(ball());
  Picture before, after;
  const Field flat = field([](const Vec3&) { return 0; }), other = bumps();
  RenderOptions turned = small(), wide = small();
  turned.camera.yaw_deg = 30;
  wide.margin_mm = 20;
  used.render(flat.shown(), small(), before);
  used.render(other.shown(), turned, before);
  used.render(other.shown(), wide, before);
  used.render(other.shown(), small(), after);
  EXPECT_EQ(after.rgba, picture(other, small()).rgba);
}

// Orbiting draws triangles anew, the front looks them up: two ways to one picture.
TEST(Render, OrbitBeginsAtTheFront) {
  RenderOptions turned = small();
  turned.camera.pitch_deg = 1e-7;
  EXPECT_LT(mean_difference(picture(bumps(), small()), picture(bumps(), turned)), .3);
  turned.camera.pitch_deg = 40;
  EXPECT_GT(mean_difference(picture(bumps(), small()), picture(bumps(), turned)), 5);
}

TEST(Render, StretchesHeightsAndNormals) {
  const Field low = bumps();
  Field high = low;
  for (float& z : high.heights) z *= 1.5F;
  for (Vec3f& n : high.normals) n = Vec3f(1.5F * n.x(), 1.5F * n.y(), n.z()).normalized();
  Shown stretched = low.shown();
  stretched.stretch = 1.5F;
  for (const double yaw : {0.0, 30.0}) {
    RenderOptions options = small();
    options.camera.yaw_deg = yaw;
    Picture made;
    FrameRenderer(ball()).render(stretched, options, made);
    EXPECT_LT(mean_difference(made, picture(high, options)), .3);
    EXPECT_GT(mean_difference(made, picture(low, options)), .5);
  }
}

TEST(Render, ZoomsAndPans) {
  RenderOptions near = small();
  near.camera.zoom = 2;
  EXPECT_DOUBLE_EQ(picture(bumps(), near).pixels_per_mm, 2 * picture(bumps(), small()).pixels_per_mm);
  near.camera.zoom = 1;
  near.camera.pan = {1000, 0};  // far beside the plate
  EXPECT_EQ(opaque_pixels(picture(bumps(), near)), 0U);
  near.camera = {0, 0, 60, {0, 0}};  // deep in the middle of it
  EXPECT_EQ(opaque_pixels(picture(bumps(), near)), 240U * 200U);
}

TEST(Render, HasTheSameBitsForAnyNumberOfThreads) {
  RenderOptions options = small();
  options.camera.yaw_deg = 20;
  options.is_fine = true;
  set_thread_count(1);
  const Picture one = picture(bumps(), options);
  set_thread_count(3);
  EXPECT_EQ(one.rgba, picture(bumps(), options).rgba);
  set_thread_count(0);
}

TEST(Render, RefusesSizesOutOfRange) {
  for (const auto& [width, height] : {std::pair{0, 10}, {10, 0}, {-5, 10}, {10, 8193}}) {
    RenderOptions options = small();
    options.width = width;
    options.height = height;
    const Picture made = picture(bumps(), options);
    EXPECT_TRUE(made.rgba.empty());
    EXPECT_EQ(made.width, 0);
  }
}

TEST(Render, ShowsTheModelItself) {
  FrameRenderer renderer(ball());
  const Shown original = renderer.original();
  const auto [lowest, highest] = std::ranges::minmax(original.heights);
  EXPECT_EQ(lowest, 0);
  EXPECT_NEAR(highest, 1, .05);
  EXPECT_EQ(original.normals.size(), original.heights.size());
}

TEST(Render, AProfileFollowsTheHeights) {
  FrameRenderer renderer(ball());
  const Field slope = field([](const Vec3& p) { return .25 * p.x() + .5; });
  const std::vector<float> cut = renderer.profile(slope.shown(), small(), {-40, 3}, {40, 3}, 81);
  ASSERT_EQ(cut.size(), 81U);
  for (int i = 0; i <= 80; ++i) EXPECT_NEAR(cut[static_cast<std::size_t>(i)], .25 * (i - 40) + 25, .1) << i;
  for (const float z : renderer.profile(slope.shown(), small(), {60, 60}, {90, 90}, 5)) EXPECT_EQ(z, 0);
  EXPECT_TRUE(renderer.profile(slope.shown(), small(), {0, 0}, {1, 1}, 0).empty());
}

TEST(CloudRenderer, ShowsABallAsADisc) {
  const CloudRenderer renderer(test::sphere(20000, 3));
  Picture made;
  renderer.render(*view_towards({1, 2, 3}), 200, 160, made);
  ASSERT_EQ(made.rgba.size(), 200U * 160U * 4U);
  const double radius = 3 * made.pixels_per_mm;
  const double share = static_cast<double>(opaque_pixels(made)) / (std::numbers::pi * radius * radius);
  EXPECT_GT(share, .99);
  EXPECT_LT(share, 1.1);  // the discs at the rim reach beyond it
  EXPECT_EQ(made.rgba[3], 0);
  EXPECT_GT(red(made, 85, 65), red(made, 125, 105));  // the lamp is at the upper left
}

TEST(CloudRenderer, DoesWithoutNormals) {
  Cloud bare = test::sphere(20000, 3);
  const CloudRenderer signed_normals(bare);
  bare.normals.clear();
  const CloudRenderer renderer(bare);
  Picture with, without;
  signed_normals.render(View{}, 100, 100, with);
  renderer.render(View{}, 100, 100, without);
  EXPECT_LT(mean_difference(with, without), 3);
}

TEST(CloudRenderer, ShowsNothingOfNothing) {
  Picture made;
  CloudRenderer(Cloud{}).render(View{}, 100, 100, made);
  EXPECT_TRUE(made.rgba.empty());
  CloudRenderer(test::sphere(1000, 1)).render(View{}, 0, 100, made);
  EXPECT_TRUE(made.rgba.empty());
}

}  // namespace
}  // namespace relievo
