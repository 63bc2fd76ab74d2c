#include "relievo/plate/base.h"

#include <rapidcheck.h>

#include <cmath>

#include "support/results.h"

namespace relievo {
namespace {

const std::vector<Vec2> plate = {
    {-40, -20}, {60, -20}, {60, 40}, {-40, 40}};  // 100 x 60, with its centre at (10, 10)
const Vec2 middle(10, 10);

std::shared_ptr<const Image<float>> ramp_image() {
  Image<float> grid = filled_image(100, 60, 0.F);
  for (std::size_t i = 0; i < 6000; ++i) grid[i] = static_cast<float>(i % 100) / 99;
  return std::make_shared<const Image<float>>(std::move(grid));
}

std::shared_ptr<const Image<float>> hilly_image() {
  Image<float> grid = filled_image(50, 40, 0.F);
  for (std::size_t i = 0; i < 2000; ++i)
    grid[i] = std::sin(.3F * static_cast<float>(i % 50)) * std::cos(.2F * static_cast<float>(i / 50));
  return std::make_shared<const Image<float>>(std::move(grid));
}

Base over(std::string_view text, std::shared_ptr<const Image<float>> image = nullptr) {
  auto options = value_of(parse_base(text));
  options.image = std::move(image);
  return value_of(Base::over(options, plate));
}

std::string complaint(std::string_view text) {
  const auto options = parse_base(text);
  return options ? message_of(Base::over(*options, plate)) : options.error().message();
}

constexpr const char* shapes[] = {"fold",          "fold:angle=30,direction=20,hollow",
                                  "wave",          "wave:height=3,length=17,direction=70",
                                  "cylinder",      "cylinder:diameter=150,direction=0,hollow",
                                  "dome",          "dome:diameter=200",
                                  "image:height=4"};

TEST(Base, LengthsMayHaveUnitsFractionsAndDecimalCommas) {
  const BaseOptions wave = parse_base("wave:height=1/4in,length=2,5cm,direction=22,5,hollow").value();
  EXPECT_DOUBLE_EQ(*wave.height_mm, 6.35);
  EXPECT_DOUBLE_EQ(*wave.length_mm, 25);
  EXPECT_DOUBLE_EQ(wave.direction_deg, 22.5);
  EXPECT_TRUE(wave.is_hollow);
  EXPECT_DOUBLE_EQ(*parse_base("dome:height=2 1/2in").value().height_mm, 63.5);
  EXPECT_TRUE(complaint("fold:angle=1in").contains("angle=DEG")) << complaint("fold:angle=1in");
}

TEST(Base, HeightsHaveTheirClosedForms) {
  EXPECT_TRUE(over("plane").is_plane());
  EXPECT_EQ(over("plane").height({31, 7}), 0);
  EXPECT_NEAR(over("fold:angle=45").height(middle + Vec2(7, 3)), -7, 1e-12);
  EXPECT_NEAR(over("fold:height=5").height({60, 0}), -5, 1e-12);
  EXPECT_NEAR(over("fold:angle=45,direction=0").height(middle + Vec2(7, 3)), -3, 1e-12);
  EXPECT_NEAR(over("wave:height=3,length=20").height(middle + Vec2(10, 5)), -3, 1e-12);
  EXPECT_NEAR(over("wave:height=3,length=20").height(middle + Vec2(20, 5)), 0, 1e-12);
  EXPECT_NEAR(over("cylinder:diameter=130").height(middle + Vec2(25, 5)), 60 - 65, 1e-12);
  EXPECT_NEAR(over("dome:diameter=130").height(middle + Vec2(15, 20)), 60 - 65, 1e-12);
  const double corner = std::hypot(50., 30.);
  EXPECT_NEAR(over("dome:height=9").height(middle + Vec2(corner, 0)), -9, 1e-9);
  EXPECT_NEAR(over("cylinder:height=9").height(middle + Vec2(50, 0)), -9, 1e-9);
  EXPECT_NEAR(over("image:height=5", ramp_image()).height(middle + Vec2(20, 3)), 20 * 5 / 99., 1e-6);
}

TEST(Base, HollowIsTheSameTurnedOver) {
  for (const char* shape : {"fold", "wave", "cylinder", "dome:height=4", "image"}) {
    const std::string hollow =
        std::string(shape) + (std::string_view(shape).contains(':') ? "," : ":") + "hollow";
    const Base hill = over(shape, hilly_image()), valley = over(hollow, hilly_image());
    for (const Vec2& p : {Vec2(3, 7), Vec2(-20, 30)}) EXPECT_EQ(hill.height(p), -valley.height(p)) << shape;
  }
}

TEST(Base, MirroredIsTheSameFromTheOtherSide) {
  for (const char* shape : shapes) {
    BaseOptions options = *parse_base(shape);
    options.image = hilly_image();
    const Base base = *Base::over(options, plate);
    options.is_mirrored = true;
    const Base mirrored = *Base::over(options, plate);
    for (const Vec2& p : {Vec2(3, 7), Vec2(-20, 30)}) {
      const Vec2 there(2 * middle.x() - p.x(), p.y());
      EXPECT_NEAR(mirrored.height(there), base.height(p), 1e-12) << shape;
    }
  }
}

TEST(Base, IsSmoothButForItsRidge) {
  EXPECT_TRUE(rc::check([] {
    const std::string shape =
        *rc::gen::elementOf(std::vector<std::string>(std::begin(shapes), std::end(shapes)));
    const Base base = over(shape, hilly_image());
    const Vec2 p(*rc::gen::inRange(-390, 590) / 10. + .01, *rc::gen::inRange(-190, 390) / 10. + .02);
    const double step = 1e-3;
    for (const Vec2& way : {Vec2(step, 0), Vec2(0, step)}) {
      if (base.ridge_between(p - way, p + way)) continue;
      const double bend = base.height(p + way) - 2 * base.height(p) + base.height(p - way);
      RC_ASSERT(std::abs(bend) < step * step);  // the curvature is below 1 / mm, so there are no steps
    }
  }));
}

TEST(Base, IsZeroInTheMiddleAndNoHigherThanAsked) {
  for (const char* shape : {"fold:height=4", "wave:height=4", "cylinder:height=4", "dome:height=4"}) {
    const Base base = over(shape);
    EXPECT_NEAR(base.height(middle), 0, 1e-12);
    double lowest = 0;
    for (double x = -40; x <= 60; x += .5)
      for (double y = -20; y <= 40; y += .5) {
        EXPECT_LE(base.height({x, y}), 1e-12);
        lowest = std::min(lowest, base.height({x, y}));
      }
    EXPECT_NEAR(lowest, -4, 2e-3) << shape;
  }
}

TEST(Base, AnImageOfStepsHasNone) {
  Image<float> grid = filled_image(200, 120, 0.F);
  for (std::size_t i = 0; i < 24000; ++i)  // a ramp with steps ten pixels wide, which are 5 mm
    grid[i] = static_cast<float>(i % 200 / 10);
  BaseOptions options = *parse_base("image:height=19");
  options.image = std::make_shared<const Image<float>>(grid);
  const Base base = *Base::over(options, plate);
  const auto slope = [&](double x) { return (base.height({x + .01, 0}) - base.height({x, 0})) / .01; };
  for (double x = -30; x < 50; x += .01) EXPECT_LT(std::abs(slope(x + .01) - slope(x)), .1);
}

TEST(Base, KnowsWhereARidgeIsCrossed) {
  const Base base = over("fold:direction=0");
  EXPECT_NEAR(base.ridge_between(middle + Vec2(3, -1), middle + Vec2(9, 3)).value(), .25, 1e-12);
  EXPECT_FALSE(base.ridge_between(middle + Vec2(3, 1), middle + Vec2(9, 3)));
  EXPECT_FALSE(over("wave").ridge_between({-30, 0}, {30, 0}));
}

TEST(Base, RefusesWhatCannotBe) {
  EXPECT_TRUE(complaint("bowl").contains("plane, fold, wave, cylinder, dome or image"));
  EXPECT_TRUE(complaint("wave:depth=3").contains("height=MM, length=MM, direction=DEG, hollow"));
  for (const char* text : {"plane:height=3", "wave:", "wave:height", "wave:height=", "wave:height=3kg",
                           "wave:height=nan", "wave:height=3,,length=4", "fold:height=-1", "fold:angle=85",
                           "fold:angle=15,height=3", "wave:height=30,length=5", "cylinder:diameter=99",
                           "dome:diameter=110", "dome:height=300", "fold:height=400", "image"})
    EXPECT_TRUE(complaint(text).starts_with("base: expected ")) << text << ": " << complaint(text);
  BaseOptions options = *parse_base("image");
  Image<float> holey = *hilly_image();
  holey[7] = std::nanf("");
  options.image = std::make_shared<const Image<float>>(holey);
  EXPECT_FALSE(Base::over(options, plate));
}

}  // namespace
}  // namespace relievo
