#include "relievo/picture/render.h"

#include "support/same_bits.h"
#include "support/surfaces.h"

namespace relievo {
namespace {

// Returns the model of a hemisphere, which is 2 wide and 2 high in the view plane.
std::shared_ptr<const ReliefModel> ball() {
  static const auto model = std::make_shared<const ReliefModel>(test::prepared(test::sphere(20000, 1)));
  return model;
}

// Heights and normals of a relief of the ball. field() computes them from a function of the position.
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
  return {.width = 240, .height = 200, .mm_per_unit = 50};
}

Picture picture(const Field& field, const RenderOptions& options) {
  FrameRenderer renderer(ball());
  Picture made;
  renderer.render(field.shown(), options, made);
  return made;
}

double mean_difference(const Picture& a, const Picture& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.image.pixels.size(); ++i)
    sum += std::abs(int{a.image.pixels[i]} - int{b.image.pixels[i]});
  return sum / static_cast<double>(a.image.pixels.size());
}

std::size_t opaque_pixels(const Picture& picture) {
  std::size_t count = 0;
  for (std::size_t i = 3; i < picture.image.pixels.size(); i += 4) count += picture.image.pixels[i] == 255;
  return count;
}

// The bounding box of the plate's pixels.
struct PlatePixels {
  Vec2 low = Vec2::Constant(1e9), high = Vec2::Constant(-1e9);
  Vec2 centre() const { return (low + high) / 2; }
  Vec2 size() const { return high - low; }
};

PlatePixels plate_in(const Picture& picture) {
  PlatePixels plate;
  for (int row = 0; row < picture.image.height; ++row)
    for (int column = 0; column < picture.image.width; ++column)
      if (picture.image.pixels[picture.image.index(column, row) + 3] == 255) {
        plate.low = plate.low.cwiseMin(Vec2(column, row));
        plate.high = plate.high.cwiseMax(Vec2(column + 1, row + 1));
      }
  return plate;
}

int red(const Picture& picture, int column, int row) {
  return picture.image.at(column, row);
}

TEST(Render, CoversThePlate) {
  for (const bool is_fine : {false, true}) {
    RenderOptions options = small();
    options.is_fine = is_fine;
    const Picture made = picture(bumps(), options);
    ASSERT_EQ(made.image.pixels.size(), 240U * 200U * 4U);
    const double side = (2 * 50 + 2 * options.margin_mm) * made.pixels_per_mm;
    EXPECT_NEAR(static_cast<double>(opaque_pixels(made)) / (side * side), 1, .02);
  }
}

TEST(Render, AFlatReliefIsEven) {
  const Picture made = picture(field([](const Vec3&) { return 0; }), small());
  for (int column = 60; column < 180; column += 7)
    for (int row = 40; row < 160; row += 7) ASSERT_EQ(red(made, column, row), red(made, 120, 100));
}

TEST(Render, AFlatReliefMirrorsTheRoomWithoutEdges) {
  for (const auto material : {Material::silver, Material::bronze, Material::porcelain}) {
    RenderOptions options = small();
    options.material = material;
    const Picture made = picture(field([](const Vec3&) { return 0; }), options);
    int darkest = 255, brightest = 0;
    for (int column = 60; column < 180; ++column)
      for (int row = 40; row < 160; ++row) {
        const int here = red(made, column, row);
        ASSERT_NEAR(here, red(made, column + 1, row), 12);
        darkest = std::min(darkest, here);
        brightest = std::max(brightest, here);
      }
    EXPECT_GT(brightest - darkest, 10);
  }
}

TEST(Render, IsBrighterWhereItFacesTheLamp) {
  RenderOptions options = small();
  const auto brightness = [&](const Vec3f& normal) {
    const auto plane = [&](const Vec3& p) { return -static_cast<double>(normal.x()) * p.x(); };
    return red(picture(field(plane, normal.normalized()), options), 120, 100);
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
  EXPECT_EQ(after.image.pixels, picture(other, small()).image.pixels);
}

// If the camera is rotated, all triangles are drawn again. In the front view, cached triangles are looked up
// instead. For a camera that is hardly rotated, both ways must give almost the same picture.
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

TEST(Render, ZoomsAroundTheMiddle) {
  RenderOptions options = small();
  const Picture whole = picture(bumps(), options);
  options.camera.zoom = .5;
  const Picture half = picture(bumps(), options);
  EXPECT_DOUBLE_EQ(half.pixels_per_mm, whole.pixels_per_mm / 2);
  EXPECT_LT((plate_in(half).centre() - Vec2(120, 100)).norm(), 1);
  EXPECT_LT((plate_in(half).size() - plate_in(whole).size() / 2).norm(), 2);
  options.camera.zoom = 60;  // the picture is inside the plate
  EXPECT_EQ(opaque_pixels(picture(bumps(), options)), 240U * 200U);
}

TEST(Render, OrbitsAtTheScaleOfTheFrontAsLongAsThePlateFits) {
  RenderOptions options = small();
  const double front = picture(bumps(), options).pixels_per_mm;
  options.camera.yaw_deg = 15;
  options.camera.pitch_deg = 15;
  EXPECT_EQ(picture(bumps(), options).pixels_per_mm, front);
  for (const double yaw : {-45, 30, 60}) {
    options.camera.yaw_deg = yaw;
    options.camera.pitch_deg = 40;
    const Picture made = picture(bumps(), options);
    EXPECT_LT(made.pixels_per_mm, front);
    EXPECT_GT(plate_in(made).low.minCoeff(), 0);
    EXPECT_LT((plate_in(made).high - Vec2(240, 200)).maxCoeff(), 0);
  }
}

// `pan` is the point of the plate at the centre of the picture. So the plate moves in the opposite direction.
// Rows of the picture run downwards.
TEST(Render, PansByMillimetresOfThePlate) {
  RenderOptions options = small();
  options.camera.zoom = .5;
  const Picture before = picture(bumps(), options);
  const int right = 23, up = 17;
  options.camera.pan = Vec2(right, up) / before.pixels_per_mm;
  const Picture after = picture(bumps(), options);
  EXPECT_LT((plate_in(after).centre() - plate_in(before).centre() - Vec2(-right, up)).norm(), 1);
  EXPECT_LT((plate_in(after).size() - plate_in(before).size()).norm(), 1);
  double difference = 0;  // the relief moves with the plate
  for (int row = 60; row < 140; ++row)
    for (int column = 80; column < 160; ++column)
      difference += std::abs(red(after, column - right, row + up) - red(before, column, row));
  EXPECT_LT(difference / (80 * 80), 1);
  options.camera.pan = {1000, 0};  // far outside the plate
  EXPECT_EQ(opaque_pixels(picture(bumps(), options)), 0U);
}

TEST(Render, HasTheSameBitsForAnyNumberOfThreads) {
  RenderOptions options = small();
  options.camera.yaw_deg = 20;
  options.is_fine = true;
  test::expect_same_for_any_threads([&] { return picture(bumps(), options).image.pixels; });
}

TEST(Render, LeavesACancelledPictureUnfinishedAndDrawsTheNext) {
  RenderOptions options = small();
  options.is_fine = true;
  Cancelled progress;
  FrameRenderer renderer(ball());
  Picture made;
  const Field shown = bumps();
  renderer.render(shown.shown(), options, made, &progress);
  EXPECT_EQ(opaque_pixels(made), 0U);
  renderer.render(shown.shown(), options, made);
  EXPECT_EQ(made.image.pixels, picture(bumps(), options).image.pixels);
}

TEST(Render, RefusesSizesOutOfRange) {
  for (const auto& [width, height] : {std::pair{0, 10}, {10, 0}, {-5, 10}, {10, 8193}}) {
    RenderOptions options = small();
    options.width = width;
    options.height = height;
    const Picture made = picture(bumps(), options);
    EXPECT_TRUE(made.image.pixels.empty());
    EXPECT_EQ(made.image.width, 0);
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

// The tint must go from blue to orange on the figure, and must not change the plate around it.
TEST(Render, TintsTheFigureAlone) {
  FrameRenderer renderer(ball());
  Shown shown = renderer.original();
  Picture plain, tinted;
  renderer.render(shown, small(), plain);
  std::vector<float> tint;
  for (const Vec3& p : ball()->surface().points) tint.push_back(p.x() > 0 ? 1 : 0);
  shown.tint = tint;
  renderer.render(shown, small(), tinted);
  const int middle = 100, side = 20;
  const auto blue_minus_red = [&](const Picture& made, int x) {
    const std::uint8_t* rgba = &made.image.at(x, middle);
    return int{rgba[2]} - int{rgba[0]};
  };
  EXPECT_GT(blue_minus_red(tinted, 120 - side), 40);
  EXPECT_LT(blue_minus_red(tinted, 120 + side), -40);
  std::size_t changed = 0;
  for (int x = 0; x < small().width; ++x) {
    const bool is_changed = blue_minus_red(tinted, x) != blue_minus_red(plain, x);
    changed += is_changed;
    EXPECT_TRUE(!is_changed || std::abs(x - 120) < 95) << x;
  }
  EXPECT_GT(changed, 100U);
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
  ASSERT_EQ(made.image.pixels.size(), 200U * 160U * 4U);
  const double radius = 3 * made.pixels_per_mm;
  const double share = static_cast<double>(opaque_pixels(made)) / (std::numbers::pi * radius * radius);
  EXPECT_GT(share, .99);
  EXPECT_LT(share, 1.1);  // points are drawn as discs, which extend beyond the rim
  EXPECT_EQ(made.image.pixels[3], 0);
  EXPECT_GT(red(made, 85, 65), red(made, 125, 105));  // the lamp is at the upper left
}

TEST(CloudRenderer, DoesWithoutNormals) {
  const Cloud ball = test::sphere(20000, 3);
  const CloudRenderer signed_normals(ball), renderer(test::without_normals(ball));
  Picture with, without;
  signed_normals.render(View{}, 100, 100, with);
  renderer.render(View{}, 100, 100, without);
  EXPECT_LT(mean_difference(with, without), 3);
}

TEST(CloudRenderer, ShowsNothingOfNothing) {
  Picture made;
  CloudRenderer(Cloud{}).render(View{}, 100, 100, made);
  EXPECT_TRUE(made.image.pixels.empty());
  CloudRenderer(test::sphere(1000, 1)).render(View{}, 0, 100, made);
  EXPECT_TRUE(made.image.pixels.empty());
}

}  // namespace
}  // namespace relievo
