#include "lettering/ornament_shapes.h"

#include <array>
#include <cmath>
#include <numbers>

#include "support/results.h"

namespace relievo {
namespace {

// Returns the area for ornaments on a round plate with radius 30 around (30, 30): a polygon with its corners
// on the circle.
OrnamentFrame coin() {
  OrnamentFrame frame;
  const int n = 720;
  for (int k = 0; k < n; ++k) {
    const double angle = 2 * std::numbers::pi * k / n;
    frame.inner.emplace_back(30 + 30 * std::cos(angle), 30 + 30 * std::sin(angle));
  }
  return frame;
}

Ornament text_on(TextArc arc, const std::string& text) {
  return {.text = text, .arc = arc, .size_mm = 3};
}

RaisedShape shape_of(const Ornament& ornament, const OrnamentFrame& frame = coin()) {
  return ornament_shapes(std::array{ornament}, frame).value().at(0);
}

// Returns the smallest and the largest distance of a shape's corners from the plate's centre.
std::array<double, 2> radii_of(const RaisedShape& shape) {
  std::array<double, 2> radii = {1e9, 0};
  for (const std::vector<Vec2>& outline : shape.outlines)
    for (const Vec2& p : outline) {
      const double radius = (p - Vec2(30, 30)).norm();
      radii = {std::min(radii[0], radius), std::max(radii[1], radius)};
    }
  return radii;
}

Vec2 middle_of(const std::vector<Vec2>& outline) {
  return Box::of(outline).centre().head<2>();
}

TEST(OrnamentShapes, LettersStandInTheMiddleOfTheMargin) {
  // The margin is 5 mm wide. Capitals of 3 mm stand in its middle, so they are 1 mm from the rim.
  const auto [low, high] = radii_of(shape_of(text_on(TextArc::top, "I")));
  EXPECT_NEAR(low, 26, .01);
  EXPECT_NEAR(high, 29, .02);
  const auto [below_low, below_high] = radii_of(shape_of(text_on(TextArc::bottom, "I")));
  EXPECT_NEAR(below_low, 26, .02);
  EXPECT_NEAR(below_high, 29, .02);
}

TEST(OrnamentShapes, LettersStandAsFarFromTheRimAsTheirInsetSays) {
  for (const double inset : {0., .7, 2.}) {
    Ornament text = text_on(TextArc::top, "I");
    text.inset_mm = inset;
    EXPECT_NEAR(radii_of(shape_of(text))[1], 30 - inset, .02);
    text.arc = TextArc::bottom;
    EXPECT_NEAR(radii_of(shape_of(text))[1], 30 - inset, .02);
    text.arc = TextArc::straight;
    EXPECT_NEAR(Box::of(shape_of(text).outlines.at(0)).min.y(), inset, .02);
  }
}

TEST(OrnamentShapes, LettersKeepClearOfBorders) {
  // Beads take 1.2 mm of the margin of 5 mm. Capitals of 3 mm stand in the middle of the other 3.8 mm.
  Ornament beads{.kind = OrnamentKind::beads, .size_mm = 1, .inset_mm = .2};
  OrnamentFrame frame = coin();
  frame.border_mm = margin_of_borders(std::array{text_on(TextArc::top, "I"), beads}, frame.margin_mm);
  const auto [low, high] = radii_of(shape_of(text_on(TextArc::top, "I"), frame));
  EXPECT_NEAR(low, 25.4, .02);
  EXPECT_NEAR(high, 28.4, .02);
}

TEST(OrnamentShapes, LettersThatHangBelowTheLineMakeItRise) {
  const auto [low, high] = radii_of(shape_of(text_on(TextArc::bottom, "Ip")));
  EXPECT_NEAR(low - 25, 30 - high, .15);  // the ends of a straight stroke are farther out than its middle
  EXPECT_LT(low, 25.8);
}

TEST(OrnamentShapes, ArcsAreReadFromLeftToRightAndUpright) {
  for (const TextArc arc : {TextArc::top, TextArc::bottom, TextArc::straight}) {
    const RaisedShape shape = shape_of(text_on(arc, "IL"));
    ASSERT_EQ(shape.outlines.size(), 2U);
    EXPECT_LT(middle_of(shape.outlines[0]).x(), 30);
    EXPECT_GT(middle_of(shape.outlines[1]).x(), 30);
    // The foot of the letter L reaches farthest to the right.
    Vec2 widest = shape.outlines[1][0];
    for (const Vec2& p : shape.outlines[1])
      if (p.x() > widest.x()) widest = p;
    EXPECT_LT(widest.y(), middle_of(shape.outlines[1]).y());
    EXPECT_EQ(middle_of(shape.outlines[0]).y() > 30, arc == TextArc::top);
  }
}

TEST(OrnamentShapes, LettersOnAnArcAreRigid) {
  const auto width = [](const RaisedShape& shape) {
    double most = 0;
    for (const Vec2& p : shape.outlines[0])
      for (const Vec2& q : shape.outlines[0]) most = std::max(most, (p - q).norm());
    return most;
  };
  EXPECT_NEAR(width(shape_of(text_on(TextArc::top, "HH"))), width(shape_of(text_on(TextArc::straight, "HH"))),
              1e-9);
}

TEST(OrnamentShapes, AngleTurnsTheText) {
  Ornament ornament = text_on(TextArc::top, "VITA");
  const RaisedShape at_top = shape_of(ornament);
  ornament.angle_deg = 90 + 40;
  const RaisedShape turned = shape_of(ornament);
  const double angle = 40 * std::numbers::pi / 180;
  for (std::size_t i = 0; i < at_top.outlines.size(); ++i)
    for (std::size_t k = 0; k < at_top.outlines[i].size(); ++k) {
      const Vec2 p = at_top.outlines[i][k] - Vec2(30, 30);
      const Vec2 wanted(30 + std::cos(angle) * p.x() - std::sin(angle) * p.y(),
                        30 + std::sin(angle) * p.x() + std::cos(angle) * p.y());
      EXPECT_LT((turned.outlines[i][k] - wanted).norm(), 1e-9);
    }
}

TEST(OrnamentShapes, TextAroundIsSpreadEvenly) {
  const RaisedShape shape = shape_of(text_on(TextArc::around, "IIIIIIIIIIII"));
  ASSERT_EQ(shape.outlines.size(), 12U);
  const double turn = 2 * std::numbers::pi / 12;
  for (std::size_t i = 0; i < 12; ++i) {
    double middle = 0, next = 0;
    const auto angle_of = [&](const std::vector<Vec2>& outline) {
      Vec2 sum = Vec2::Zero();
      for (const Vec2& p : outline) sum += p - Vec2(30, 30);
      return std::atan2(sum.y(), sum.x());
    };
    middle = angle_of(shape.outlines[i]), next = angle_of(shape.outlines[(i + 1) % 12]);
    EXPECT_NEAR(std::remainder(middle - next, 2 * std::numbers::pi), turn, 1e-6);
  }
}

TEST(OrnamentShapes, MirrorsAndSinksForDies) {
  OrnamentFrame die = coin();
  die.is_mirrored = die.is_die = true;
  const RaisedShape raised = shape_of(text_on(TextArc::top, "LEX")),
                    sunk = shape_of(text_on(TextArc::top, "LEX"), die);
  EXPECT_EQ(sunk.levels[1].height_mm, -raised.levels[1].height_mm);
  for (std::size_t i = 0; i < raised.outlines.size(); ++i)
    for (std::size_t k = 0; k < raised.outlines[i].size(); ++k)
      EXPECT_LT(
          (sunk.outlines[i][k] - Vec2(60 - raised.outlines[i][k].x(), raised.outlines[i][k].y())).norm(),
          1e-9);
}

TEST(OrnamentShapes, StayBelowTheRimUnlessAHeightIsGiven) {
  OrnamentFrame frame = coin();
  frame.rim_mm = .4;
  EXPECT_NEAR(shape_of(text_on(TextArc::top, "A"), frame).levels[1].height_mm, .32, 1e-12);
  Ornament high = text_on(TextArc::top, "A");
  high.height_mm = 1.5;
  EXPECT_EQ(shape_of(high, frame).levels[1].height_mm, 1.5);
  EXPECT_NEAR(shape_of(high, frame).levels[1].distance_mm, 1.5 / frame.slope, 1e-12);
}

TEST(OrnamentShapes, BeadsAreDiscsAlongTheRim) {
  Ornament beads{.kind = OrnamentKind::beads, .size_mm = 1, .inset_mm = .5, .count = 40};
  const RaisedShape shape = shape_of(beads);
  ASSERT_EQ(shape.outlines.size(), 40U);
  for (const std::vector<Vec2>& outline : shape.outlines)
    EXPECT_NEAR((middle_of(outline) - Vec2(30, 30)).norm(), 29, .01);
  EXPECT_NEAR(radii_of(shape)[1], 29.5, .01);
}

TEST(OrnamentShapes, ALineLiesBetweenTwoCircles) {
  Ornament line{.kind = OrnamentKind::line, .size_mm = .8, .inset_mm = 1};
  const auto [low, high] = radii_of(shape_of(line));
  EXPECT_NEAR(low, 28.2, .01);
  EXPECT_NEAR(high, 29, .01);
}

TEST(OrnamentShapes, StrandsOfARopeDoNotTouch) {
  const RaisedShape shape = shape_of(Ornament{.kind = OrnamentKind::rope});
  std::size_t corners = 0;
  for (const std::vector<Vec2>& outline : shape.outlines) corners += outline.size();
  EXPECT_EQ(union_boundary(shape.outlines).size(), corners);
}

TEST(OrnamentShapes, DrawingsHaveTheirSizeAndPlace) {
  Ornament drawing{
      .kind = OrnamentKind::drawing, .size_mm = 10, .outlines = {{{0, 0}, {200, 0}, {200, 100}, {0, 100}}}};
  drawing.at_mm = Vec2(0, -20);
  const RaisedShape shape = shape_of(drawing);
  EXPECT_EQ(shape.outlines[0][0], Vec2(25, 7.5));
  EXPECT_EQ(shape.outlines[0][2], Vec2(35, 12.5));
}

TEST(OrnamentShapes, RefuseWhatHasNoRoom) {
  const auto refusal = [](const Ornament& ornament) {
    return message_of(ornament_shapes(std::array{ornament}, coin()));
  };
  EXPECT_TRUE(refusal(text_on(TextArc::top, std::string(80, 'M'))).contains("all around its circle"));
  Ornament wide{.kind = OrnamentKind::line, .size_mm = 40};
  EXPECT_TRUE(refusal(wide).contains("within"));
  EXPECT_NE(
      refusal(Ornament{.kind = OrnamentKind::drawing}).find("expected a drawing with an area, found none"),
      std::string::npos);
  Ornament sizeless{.kind = OrnamentKind::drawing, .outlines = {{{0, 0}, {2, 0}, {2, 1}}}};
  EXPECT_TRUE(refusal(sizeless).contains("expected a drawing with its size, found none"));
  // The size of a drawing is its width, so this very narrow drawing would be much too high.
  Ornament thin = sizeless;
  thin.outlines = {{{0, 0}, {1, 0}, {1, 1e14}}};
  thin.size_mm = 10;
  EXPECT_TRUE(refusal(thin).contains("expected a drawing of at most "));
  Ornament flat = text_on(TextArc::top, "A");
  flat.height_mm = 0;
  EXPECT_TRUE(refusal(flat).contains("lengths"));
}

}  // namespace
}  // namespace relievo
