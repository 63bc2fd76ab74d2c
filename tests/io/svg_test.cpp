#include "relievo/io/svg.h"

#include <cmath>
#include <numbers>

#include "geometry/outline_union.h"
#include "geometry/plane.h"
#include "support/results.h"

namespace relievo {
namespace {

std::string svg_of(const std::string& path, const std::string& more = {}) {
  return "<svg xmlns=\"http://www.w3.org/2000/svg\"><path " + more + " d=\"" + path + "\"/></svg>";
}

double area_of(const std::string& text) {
  double twice = 0;
  for (const Segment& s : union_boundary(value_of(read_svg(text, "a.svg")))) twice += cross(s.from, s.to);
  return twice / 2;
}

void expect_same(const std::string& a, const std::string& b) {
  const auto first = value_of(read_svg(svg_of(a), "a.svg")), second = value_of(read_svg(svg_of(b), "b.svg"));
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    ASSERT_EQ(first[i].size(), second[i].size());
    for (std::size_t k = 0; k < first[i].size(); ++k) EXPECT_LT((first[i][k] - second[i][k]).norm(), 1e-9);
  }
}

TEST(ReadSvg, TurnsYUp) {
  const auto outlines = value_of(read_svg(svg_of("M0 0H30V10L0,10z"), "a.svg"));
  ASSERT_EQ(outlines.size(), 1U);
  EXPECT_EQ(outlines[0], (std::vector<Vec2>{{0, 0}, {30, 0}, {30, -10}, {0, -10}}));
}

TEST(ReadSvg, RelativeCommandsMeanTheSame) {
  expect_same("M10 20 L30 20 L30 40 Z", "m10,20 l20,0 0,20z");
  expect_same("M10 20 H30 V40 Z", "m10 20h20v20z");
  expect_same("M1 2 C3 4 5 6 7 2 S9 9 1 9 Z", "m1 2c2 2 4 4 6 0s2 7-6 7z");
  expect_same("M1 2 Q3 7 7 2 T9 9 Z", "m1 2q2 5 6 0t2 7z");
  expect_same("M1 2 A3 4 30 0 1 7 2 Z", "m1 2a3 4 30 016 0z");
}

TEST(ReadSvg, SmoothCommandsMirrorTheLastControlPoint) {
  expect_same("M0 0C0 5 5 5 5 0S10-5 10 0Z", "M0 0C0 5 5 5 5 0C5-5 10-5 10 0Z");
  expect_same("M0 0Q2 5 5 0T10 0Z", "M0 0Q2 5 5 0Q8-5 10 0Z");
}

TEST(ReadSvg, ArcsAreEllipses) {
  EXPECT_NEAR(area_of(svg_of("M-3 0A3 2 0 0 1 3 0A3 2 0 0 1-3 0Z")), 6 * std::numbers::pi, .01);
  // The chord is as long as the radius. So the smaller of its two arcs cuts off a circular segment whose area
  // is that of a sixth of the disc minus a triangle.
  const double segment = std::numbers::pi / 6 * 100 - std::sqrt(3.) / 4 * 100;
  EXPECT_NEAR(area_of(svg_of("M0 0A10 10 0 0 1 10 0Z")), segment, .05);
  EXPECT_NEAR(area_of(svg_of("M0 0A10 10 0 1 1 10 0Z")), 100 * std::numbers::pi - segment, .3);
  // If the radii are too small, the arc grows until it connects the ends of the chord.
  EXPECT_NEAR(area_of(svg_of("M0 0A1 1 0 0 1 10 0Z")), 12.5 * std::numbers::pi, .02);
}

TEST(ReadSvg, FollowsTheFillRule) {
  const std::string nested = "M0 0H10V10H0ZM2 2H8V8H2Z";
  EXPECT_NEAR(area_of(svg_of(nested)), 100, 1e-9);
  EXPECT_NEAR(area_of(svg_of(nested, "fill-rule=\"evenodd\"")), 64, 1e-9);
  EXPECT_NEAR(area_of(svg_of(nested, "style=\"stroke:none; fill-rule:evenodd\"")), 64, 1e-9);
}

TEST(ReadSvg, LeavesOutWhatIsNotFilled) {
  const std::string text =
      "<svg><defs><path d=\"M0 0H9V9Z\"/></defs><g style=\"fill:none\"><path d=\"M0 0H5V5Z\"/></g>"
      "<path d=\"M0 0H1V1H0Z\"/></svg>";
  EXPECT_NEAR(area_of(text), 1, 1e-9);
  expect_error(read_svg(svg_of("M0 0H5V5Z", "fill=\"none\""), "a.svg"), "expected a filled path, found none");
}

TEST(ReadSvg, ALineAfterAClosedOutlineBeginsWhereThatBegan) {
  expect_same("M1 1H5V5ZL1 9L0 9Z", "M1 1H5V5ZM1 1L1 9L0 9Z");
}

// Illustrator, older versions of Inkscape, and potrace write document types into their files.
TEST(ReadSvg, SkipsADocumentType) {
  const std::string plain = svg_of("M0 0h4v4h-4z"), head = "<?xml version=\"1.0\"?>\n<!DOCTYPE svg ";
  const std::string by_name =
      "PUBLIC \"-//W3C//DTD SVG 1.1//EN\" \"http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd\"";
  for (const std::string& type :
       {by_name + ">\n", by_name + " [\n<!ENTITY ns \"http://x\">\n<!ENTITY b \"1\">\n]>"})
    EXPECT_EQ(area_of(head + type + plain), 16) << type;
  EXPECT_FALSE(read_svg(head + by_name, "a.svg"));
  EXPECT_FALSE(read_svg(plain + "<!DOCTYPE svg>", "a.svg"));
}

TEST(ReadSvg, RefusesWhatItDoesNotRead) {
  expect_error(read_svg("<html/>", "a.svg"), "expected svg, found html");
  expect_error(read_svg("<svg><rect/></svg>", "a.svg"), "expected paths alone, found rect");
  expect_error(read_svg(svg_of("M0 0H9V9Z", "transform=\"scale(2)\""), "a.svg"),
               "expected paths without transform, found one on path");
  expect_error(read_svg(svg_of("M0 0L9"), "a.svg"), "expected numbers of the command");
  expect_error(read_svg(svg_of("9 9L3 3"), "a.svg"), "expected a command, found '9 9L3 3'");
  expect_error(read_svg(svg_of("M0 0L1e300 4Z"), "a.svg"), "expected numbers");
  expect_error(read_svg("no svg", "a.svg"), ErrorKind::input, "a.svg");
}

}  // namespace
}  // namespace relievo
