#include "relievo/options.h"

#include <limits>

#include "relievo/option_table.h"
#include "relievo/relief/weights.h"
#include "support/results.h"

namespace relievo {
namespace {

TEST(Options, DefaultsAreValid) {
  const ReliefOptions options;
  EXPECT_EQ(message_of(check(options)), "no error");
  EXPECT_EQ(options.effective_method(), Method::layered);
  EXPECT_EQ(options.effective_height_mm(), 5);
}

TEST(Options, OfThePapersMethodAreThePapers) {
  ReliefOptions options{{.alpha = 4}};
  EXPECT_EQ(message_of(check(options)), "no error");
  EXPECT_EQ(options.effective_method(), Method::paper);
  EXPECT_FALSE(options.effective_height_mm());
  EXPECT_EQ(options.effective_alpha(), 4);
  EXPECT_EQ(options.effective_saturation(), .01);
  EXPECT_EQ(options.effective_detail(), .02);
  options = {{.height_mm = 3}};
  options.method = Method::paper;
  EXPECT_EQ(options.effective_saturation(), .01);
  EXPECT_EQ(options.effective_detail(), .02);
}

TEST(Options, WithAHeightCompressEvenly) {
  ReliefOptions options{{.height_mm = 3}};
  EXPECT_EQ(options.effective_saturation(), 0);
  EXPECT_EQ(options.effective_detail(), .04);
  options.saturation = 2;
  options.detail = 0;
  EXPECT_EQ(options.effective_saturation(), 2);
  EXPECT_EQ(options.effective_detail(), 0);
}

TEST(Options, OutOfRangeAreNamed) {
  ReliefOptions options{{.width_mm = -5}};
  EXPECT_EQ(message_of(check(options)), "width: expected a number from 0.1 to 100000, found -5");
  options.width_mm = std::numeric_limits<double>::quiet_NaN();
  expect_error(check(options), "width");
  options = {};
  options.height_mm = 0;
  expect_error(check(options), "height");
  options = {};
  options.thickness_mm = std::numeric_limits<double>::infinity();
  expect_error(check(options), "thickness");
}

TEST(Options, PlatesHaveASizeThatTheirOutlineCanHave) {
  ReliefOptions options{{.diameter_mm = 80}};
  options.outline = Outline::circle;
  EXPECT_EQ(message_of(check(options)), "no error");
  options.rim_mm = 39;  // the margin is 1 mm wide
  EXPECT_EQ(message_of(check(options)),
            "diameter: expected more than 80 mm, which margin and rim take, found 80 mm");
  options = {};
  options.rim_mm = options.rim_bevel_mm = 2;
  options.outline = Outline::ellipse;
  options.plate_mm = Vec2(200, 89);  // the margin is 5 mm, and the bevel is as wide as the rim
  options.shift_mm = Vec2(5, 0);
  EXPECT_EQ(message_of(check(options)), "no error");
}

TEST(Options, MethodsHaveWhatTheyNeed) {
  ReliefOptions options;
  options.method = Method::gradient;
  EXPECT_EQ(message_of(check(options)), "no error");
  options.alpha = 4;
  EXPECT_EQ(message_of(check(options)), "alpha: expected method paper with it, found gradient");
  options.alpha.reset();
  options.detail = .1;
  expect_error(check(options), "detail");
}

TEST(Options, HaveOneHeightAtMost) {
  ReliefOptions options{{.height_of_diagonal = .05}};
  EXPECT_EQ(message_of(check(options)), "no error");
  options.alpha = 4;
  EXPECT_EQ(message_of(check(options)), "alpha: expected either height or alpha, found both");
  options.height_mm = 3;
  EXPECT_EQ(message_of(check(options)),
            "height-of-diagonal: expected either height or height-of-diagonal, found both");
}

TEST(Options, HaveAVerticalScaleOrAHeight) {
  ReliefOptions options{{.ground_value = 3}};
  EXPECT_EQ(message_of(check(options)), "ground: expected mm-per-value with it, found none");
  options.mm_per_value = .1;
  EXPECT_EQ(message_of(check(options)), "no error");
  EXPECT_EQ(options.effective_method(), Method::linear);
  EXPECT_FALSE(options.effective_height_mm());
  options.height_mm = 3;
  EXPECT_EQ(message_of(check(options)), "mm-per-value: expected no height beside it, found one");
  options.height_mm.reset();
  options.method = Method::layered;
  EXPECT_EQ(message_of(check(options)), "mm-per-value: expected method linear with it, found layered");
  options.method.reset();
  options.draft_deg = 10;
  EXPECT_EQ(message_of(check(options)),
            "mm-per-value: expected neither a lithophane nor a draft beside it, found one");
  options.draft_deg.reset();
  options.colour_mm = 1;
  EXPECT_EQ(message_of(check(options)),
            "mm-per-value: expected neither strokes nor colour beside it, found one");
}

TEST(Options, HaveControlPointsInASubspaceOnly) {
  ReliefOptions options{{.control_points = 4000}};
  EXPECT_EQ(message_of(check(options)),
            "control-points: expected mode subspace or auto with it, found exact");
  options.mode = Mode::automatic;
  EXPECT_EQ(message_of(check(options)), "no error");
}

TEST(Options, TheSoftRimIsAsWideAsTheMethodStartsFrom) {
  ReliefOptions options{{.height_mm = 3}};
  for (const Method method : {Method::layered, Method::paper}) {
    options.method = method;
    EXPECT_EQ(options.effective_boundary_width(), default_shape(method).boundary_width) << name_of(method);
  }
}

TEST(Options, TextsGetAMarginThatHasRoomForThem) {
  const auto margin = [](const OptionValues& values) {
    return parse_options(values).value().effective_margin_mm();
  };
  EXPECT_EQ(margin({{"diameter", 40.}}), 1);
  EXPECT_EQ(margin({{"diameter", 40.}, {"text", "LEX"}}), 5);
  EXPECT_EQ(margin({{"text", "LEX"}, {"text-size", 6.}}), 10);
  EXPECT_EQ(margin({{"text", "LEX"}, {"text-size", 6.}, {"margin", 7.}}), 7);
}

TEST(Options, TextBecomesTheFirstOrnament) {
  ReliefOptions options =
      parse_options({{"text", "LEX"}, {"text-arc", "top"}, {"text-height", -.3}, {"text-inset", .9}}).value();
  options.ornaments.emplace_back().kind = OrnamentKind::beads;
  const std::vector<Ornament> all = options.all_ornaments();
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].text, "LEX");
  EXPECT_EQ(all[0].arc, TextArc::top);
  EXPECT_EQ(all[0].height_mm, -.3);
  EXPECT_EQ(all[0].inset_mm, .9);
  EXPECT_EQ(all[1].kind, OrnamentKind::beads);
}

}  // namespace
}  // namespace relievo
