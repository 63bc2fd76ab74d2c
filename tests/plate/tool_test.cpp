#include "relievo/plate/tool.h"
#include "relievo/picture/height_map.h"

#include <rapidcheck.h>

#include <limits>

#include "support/plate_fronts.h"
#include "support/same_bits.h"
#include "support/shapes.h"

namespace relievo {
namespace {

const Tool ball{Tool::Kind::ball, 2}, flat{Tool::Kind::flat, 3}, sharp{Tool::Kind::v, 0, 60};

Image<float> picture(int width, int height, const auto& z) {
  Image<float> image{width, height, 1, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) image.pixels.push_back(static_cast<float>(z(x, y)));
  return image;
}

// Computes, by the definition of a closing, the heights that the tool leaves. The tool is lowered at every
// sample, and also up to the length of the picture's longer side outside the picture. Each sample gets the
// lowest height that any position of the tool leaves there.
Image<float> closed_by_brute_force(const Image<float>& z, double step, const Tool& tool) {
  const int border = std::max(z.width, z.height);
  Image<float> left = z;
  for (float& value : left.pixels)
    if (value == value) value = std::numeric_limits<float>::infinity();
  float lowest = std::numeric_limits<float>::infinity(), highest = -lowest;
  for (const float value : z.pixels)
    if (value == value) lowest = std::min(lowest, value), highest = std::max(highest, value);
  // The flank of a V tool ends where it has risen by the range of the picture's heights.
  const double half_angle = tool.angle_deg * std::numbers::pi / 360,
               flank = tool.tip_mm / 2 + static_cast<double>(highest - lowest) * std::tan(half_angle);
  const auto profile = [&](int dx, int dy) {
    const double distance = step * std::hypot(dx, dy) * (1 - 1e-12);
    const bool is_beyond = tool.kind == Tool::Kind::v && distance > flank;
    return is_beyond ? std::numeric_limits<float>::infinity()
                     : static_cast<float>(tool_profile(tool, distance));
  };
  const auto each_sample = [&](auto&& f) {
    for (int y = 0; y < z.height; ++y)
      for (int x = 0; x < z.width; ++x)
        if (const std::size_t i = static_cast<std::size_t>(y * z.width + x); z.pixels[i] == z.pixels[i])
          f(x, y, i);
  };
  for (int row = -border; row < z.height + border; ++row)
    for (int column = -border; column < z.width + border; ++column) {
      float stands = -std::numeric_limits<float>::infinity();
      each_sample([&](int x, int y, std::size_t i) {
        stands = std::max(stands, z.pixels[i] - profile(x - column, y - row));
      });
      each_sample([&](int x, int y, std::size_t i) {
        left.pixels[i] = std::min(left.pixels[i], stands + profile(x - column, y - row));
      });
    }
  return left;
}

TEST(Tool, IsParsed) {
  const Tool v = parse_tool("v:30:0.5").value();
  EXPECT_EQ(v.kind, Tool::Kind::v);
  EXPECT_EQ(v.angle_deg, 30);
  EXPECT_EQ(v.tip_mm, .5);
  EXPECT_EQ(parse_tool("ball:1.5")->diameter_mm, 1.5);
  EXPECT_EQ(parse_tool("flat:2")->kind, Tool::Kind::flat);
  EXPECT_EQ(parse_tool("flat:1/8in")->diameter_mm, 3.175);
  EXPECT_EQ(parse_tool("v:60:0.01", LengthUnit::inch)->tip_mm, .254);
  for (const char* text : {"ball:1.5mm", "flat:0.25mm", "v:60", "v:30:0.5mm"})
    EXPECT_EQ(text_of(*parse_tool(text)), text);
  for (const char* text : {"", "ball", "ball:", "ball:x", "ball:1ft", "ball:-1", "ball:0", "ball:1:2", "v:0",
                           "v:171", "v:60:", "v:60:-1", "cone:3", "ball:nan", "flat:1e9"}) {
    expect_error(parse_tool(text), "tool: expected ");
  }
}

TEST(Tool, ProfilesAreBallsPlanesAndCones) {
  EXPECT_EQ(tool_profile(ball, 0), 0);
  EXPECT_NEAR(tool_profile(ball, .6), 1 - .8, 1e-12);
  EXPECT_EQ(tool_profile(ball, 1), 1);
  EXPECT_TRUE(std::isinf(tool_profile(ball, 1.001)));
  EXPECT_EQ(tool_profile(flat, 1.5), 0);
  EXPECT_TRUE(std::isinf(tool_profile(flat, 1.501)));
  EXPECT_NEAR(tool_profile(sharp, 1), std::sqrt(3), 1e-12);
  // The ball of a rounded tip must meet the flank without a step or a crease.
  const Tool tapered{Tool::Kind::v, 0, 40, 2};
  const double touching = std::cos(20 * std::numbers::pi / 180), e = 1e-6;
  const auto at = [&](double r) { return tool_profile(tapered, r); };
  EXPECT_NEAR(at(touching - e), at(touching + e), 1e-5);
  EXPECT_NEAR((at(touching) - at(touching - e)) / e, (at(touching + e) - at(touching)) / e, 1e-4);
  EXPECT_NEAR(at(.5), 1 - std::sqrt(.75), 1e-12);
}

TEST(CloseByTool, IsTheDefinition) {
  test::Random random(3);
  const Tool tools[] = {
      ball, flat, sharp, {Tool::Kind::v, 0, 90, 1}, {Tool::Kind::ball, 4}, {Tool::Kind::flat, .1}};
  for (const Tool& tool : tools)
    for (const auto& [width, height] : {std::pair(23, 14), std::pair(1, 16), std::pair(40, 3)}) {
      Image<float> z = picture(width, height, [&](int, int) { return random.uniform(0, 1.5); });
      for (float& value : z.pixels)
        if (random.uniform() < .1) value = std::numeric_limits<float>::quiet_NaN();
      const Image<float> expected = closed_by_brute_force(z, .25, tool), found = close_by_tool(z, .25, tool);
      for (std::size_t i = 0; i < z.pixels.size(); ++i) {
        ASSERT_EQ(std::isnan(found.pixels[i]), std::isnan(z.pixels[i]));
        if (std::isnan(z.pixels[i])) continue;
        ASSERT_NEAR(found.pixels[i], expected.pixels[i], 1e-5) << i << " of " << width << " x " << height;
      }
    }
}

// A ball in a groove touches both walls, so the height of the material that remains at the bottom is known.
TEST(CloseByTool, ABallInAGroove) {
  const double step = .01, half = .3, radius = 1;
  const auto groove = picture(301, 41, [&](int x, int) { return std::abs(x - 150) * step <= half ? 0 : 2; });
  const Image<float> left = close_by_tool(groove, step, ball);
  // The ball rests on the upper edges of both walls. The distance of these edges from the ball's axis is
  // `half` plus one sample.
  const double edge = half + step;
  EXPECT_NEAR(left.pixels[20 * 301 + 150], 2 - (radius - std::sqrt(radius * radius - edge * edge)), 1e-5);
}

// A ball must leave material of its own shape at the foot of a wall.
TEST(CloseByTool, ABallAtAWall) {
  const double step = .02;
  const auto wall = picture(200, 21, [&](int x, int) { return x < 100 ? 0 : 3; });
  const Image<float> left = close_by_tool(wall, step, ball);
  for (int x = 20; x < 100; ++x) {
    const double from_axis = (x - 49) * step;  // the axis cannot come nearer to the wall than sample 49
    const double expected = from_axis > 0 ? 1 - std::sqrt(std::max(0.0, 1 - from_axis * from_axis)) : 0;
    EXPECT_NEAR(left.pixels[10 * 200 + static_cast<std::size_t>(x)], expected, 1e-5) << x;
  }
}

TEST(CloseByTool, AVReachesSlopesUpToItsFlank) {
  const auto valley = [](double slope) {
    return picture(161, 21, [&](int x, int) { return slope * std::abs(x - 80) * .05; });
  };
  const Image<float> gentle = valley(1.7), steep = valley(2.5);
  EXPECT_LT(close_by_tool(gentle, .05, sharp).pixels[10 * 161 + 80], 1e-5);
  // Between steeper walls, the tool touches only the upper ends of the walls.
  EXPECT_NEAR(close_by_tool(steep, .05, sharp).pixels[10 * 161 + 80], 4 * (2.5 - std::sqrt(3)), 1e-4);
}

TEST(CloseByTool, IsAClosing) {
  ASSERT_TRUE(rc::check([] {
    test::Random random(*rc::gen::arbitrary<std::uint64_t>());
    const int width = *rc::gen::inRange(22, 70), height = *rc::gen::inRange(1, 40);
    const Image<float> z = picture(width, height, [&](int, int) { return random.uniform(0, 2); });
    const Tool tool{*rc::gen::element(Tool::Kind::ball, Tool::Kind::flat, Tool::Kind::v),
                    random.uniform(.2, 4), random.uniform(20, 120), random.uniform(0, 1)};
    const Image<float> once = close_by_tool(z, .2, tool), twice = close_by_tool(once, .2, tool);
    for (std::size_t i = 0; i < z.pixels.size(); ++i) {
      RC_ASSERT(once.pixels[i] >= z.pixels[i]);
      // V tools are not compared, because their flanks end lower in the second pass.
      RC_ASSERT(tool.kind == Tool::Kind::v || std::abs(twice.pixels[i] - once.pixels[i]) < 1e-5F);
    }
    RC_ASSERT(*std::ranges::max_element(once.pixels) == *std::ranges::max_element(z.pixels));
  }));
}

TEST(CloseByTool, IsTheSameForAnyNumberOfThreadsAndInstructions) {
  const Image<float> z = picture(333, 77, [](int x, int y) { return std::sin(.3 * x) * std::cos(.2 * y); });
  const auto close = [&] { return close_by_tool(z, .1, ball).pixels; };
  test::expect_same_for_any_threads(close);
  test::expect_same_without_avx2(close);
}

Solid plate_with_step(double height) {
  HeightFieldMesh front =
      test::grid_front({40, 20, 80, 40}, [&](double x, double) { return x > 10 && x < 30 ? height : 0.; });
  return test::plate_of(front);
}

// The walls rise by 3 mm within 0.5 mm, around a square of 20 x 20 mm on a plate of 50 x 30 mm.
TEST(MeasureReach, OfABallAtTheFootOfWalls) {
  const ToolReach reach = measure_reach(plate_with_step(3), ball);
  // The ball of radius 1 mm touches the ground at the distance `from_foot` from the foot of the wall.
  // It stays `above_foot` above the foot itself.
  const double from_foot = std::tan(std::atan(6) / 2), above_foot = 1 - std::sqrt(1 - from_foot * from_foot);
  EXPECT_NEAR(reach.largest_residual_mm, above_foot, 6 * reach.mm_per_sample / 2);
  const double on_ground = from_foot - std::sqrt(2 * .01), on_wall = from_foot * std::cos(std::atan(6));
  EXPECT_NEAR(1 - reach.reached_share, 80 * (on_ground + on_wall) / (50 * 30), .004);
  EXPECT_EQ(reach.tolerance_mm, .01);
  EXPECT_NEAR(reach.mm_per_sample, 50.0 / 2048, 1e-12);
}

TEST(MeasureReach, OfAFlatPlateIsAll) {
  const ToolReach reach = measure_reach(plate_with_step(0), flat);
  EXPECT_EQ(reach.reached_share, 1);
  EXPECT_EQ(reach.largest_residual_mm, 0);
  EXPECT_EQ(measure_reach({}, flat).reached_share, 1);
}

TEST(MeasureReach, BesideAPlateThereIsNoObstacle) {
  HeightFieldMesh front = test::flat_front({20, 10, 4, 2});
  const Solid round = test::plate_of(front, {5, 3, Outline::circle});
  const ToolReach reach = measure_reach(round, ball);
  EXPECT_EQ(reach.reached_share, 1);
  EXPECT_TRUE(std::isnan(reach.residual_mm.pixels[0]));
}

TEST(RenderReach, ShowsInRedWhatIsLeft) {
  const auto reds = [](const Image8& image) {
    int count = 0;
    for (std::size_t i = 0; i < image.pixels.size(); i += 3)
      count += image.pixels[i] > image.pixels[i + 2] + 60;
    return count;
  };
  const Image8 step = render_reach(measure_reach(plate_with_step(3), ball), 400);
  EXPECT_LE(step.width, 400);
  EXPECT_GT(reds(step), 500);
  EXPECT_EQ(reds(render_reach(measure_reach(plate_with_step(0), ball), 400)), 0);
  EXPECT_TRUE(render_reach({}, 400).pixels.empty());
}

}  // namespace
}  // namespace relievo
