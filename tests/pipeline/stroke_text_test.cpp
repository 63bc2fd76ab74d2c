#include "relievo/relief/stroke.h"
#include "support/results.h"

namespace relievo {
namespace {

std::string error_of(std::string_view text) {
  return parse_strokes(text).error().expected;
}

TEST(StrokeText, GivesAllFields) {
  const Strokes strokes = value_of(parse_strokes(
      R"([{"brush": "strengthen", "amount": 2, "radius": 3, "softness": 0.5, "name": "brow", "muted": true,
           "points": [[0, 1, 2], [1, -1.5, 2e2]]},
          {"brush": "sink", "radius": 0.1, "points": [[0, 0, 0]]}])"));
  ASSERT_EQ(strokes.size(), 2U);
  EXPECT_EQ(strokes[0], (Stroke{"brow", Brush::strengthen, 2, 3, .5, true, {{0, 1, 2}, {1, -1.5, 200}}}));
  EXPECT_EQ(strokes[1], (Stroke{"", Brush::sink, 1, .1, 1, false, {{0, 0, 0}}}));
}

TEST(StrokeText, GivesAreas) {
  const Strokes strokes = value_of(parse_strokes(
      R"([{"brush": "protect", "radius": 1, "area": "lasso", "points": [[0,0,0],[1,0,0],[0,1,0]],
           "direction": [0, 0, 2]},
          {"brush": "in-front", "radius": 1, "area": "region", "points": [[1,2,3]], "tolerance": 9},
          {"brush": "raise", "radius": 1, "area": "line", "points": [[1,2,3]]}])"));
  ASSERT_EQ(strokes.size(), 3U);
  EXPECT_EQ(strokes[0].area, StrokeArea::lasso);
  EXPECT_EQ(strokes[0].brush, Brush::protect);
  EXPECT_EQ(strokes[0].direction, Vec3(0, 0, 2));
  EXPECT_EQ(strokes[1].area, StrokeArea::region);
  EXPECT_EQ(strokes[1].brush, Brush::in_front);
  EXPECT_EQ(strokes[1].tolerance, 9);
  EXPECT_EQ(strokes[2].area, StrokeArea::line);
}

TEST(StrokeText, MayBeEmpty) {
  EXPECT_TRUE(value_of(parse_strokes("")).empty());
  EXPECT_TRUE(value_of(parse_strokes("[]")).empty());
}

TEST(StrokeText, ErrorsNameTheStrokeAndTheKey) {
  EXPECT_EQ(
      error_of("[{]"),
      "expected strokes in JSON or a file with them, found '[{]', which is no JSON at line 1, column 3");
  EXPECT_EQ(error_of("{}"), "expected a JSON array of at most 10000 strokes, found {}");
  EXPECT_EQ(error_of("[3]"), "stroke 1: expected an object, found 3");
  const auto of = [](const std::string& fields) {
    return error_of(R"([{"brush": "sink", "radius": 1, "points": [[0, 0, 0]], )" + fields + "}]");
  };
  EXPECT_EQ(of(R"("size": 1)"),
            "stroke 1: expected brush, amount, radius, softness, points, name, muted, area, direction or "
            "tolerance, found 'size'");
  EXPECT_EQ(of(R"("brush": "paint")"),
            "stroke 1: expected strengthen, sharpen, soften, raise, sink, level, protect or in-front as "
            "brush, found \"paint\"");
  EXPECT_EQ(of(R"("brush": 3)"),
            "stroke 1: expected strengthen, sharpen, soften, raise, sink, level, protect or in-front as "
            "brush, found 3");
  EXPECT_EQ(of(R"("amount": 2)"), "stroke 1: expected amount from 0 to 1, found 2");
  EXPECT_EQ(of(R"("softness": 0)"), "stroke 1: expected softness from 0.05 to 1, found 0");
  EXPECT_EQ(of(R"("radius": "wide")"), "stroke 1: expected radius from 1e-09 to 1e+09, found \"wide\"");
  EXPECT_EQ(of(R"("muted": 1)"), "stroke 1: expected muted to be true or false, found 1");
  EXPECT_EQ(of(R"("name": 1)"), "stroke 1: expected a text as name, found 1");
  EXPECT_EQ(of(R"("points": [])"), "stroke 1: expected 1 to 100000 points [x, y, z], found []");
  EXPECT_EQ(of(R"("points": [[0, 1]])"), "stroke 1: expected a point [x, y, z], found [0,1]");
  EXPECT_EQ(of(R"("area": "disc")"), "stroke 1: expected line, lasso or region as area, found \"disc\"");
  EXPECT_EQ(of(R"("area": "lasso")"), "stroke 1: expected at least three points of a lasso, found 1");
  EXPECT_EQ(of(R"("area": "lasso", "points": [[0,0,0],[1,0,0],[0,1,0]])"),
            "stroke 1: expected a direction of the lasso that is not 0");
  EXPECT_EQ(of(R"("direction": [1])"), "stroke 1: expected a direction [x, y, z], found [1]");
  EXPECT_EQ(of(R"("area": "region", "points": [[0,0,0],[1,0,0]])"),
            "stroke 1: expected one point of a region, found 2");
  EXPECT_EQ(of(R"("tolerance": 0)"), "stroke 1: expected tolerance from 0.1 to 180, found 0");
  EXPECT_EQ(error_of(R"([{"brush": "sink", "points": [[0, 0, 0]]}])"),
            "stroke 1: expected a radius in the units of the scan");
}

}  // namespace
}  // namespace relievo
