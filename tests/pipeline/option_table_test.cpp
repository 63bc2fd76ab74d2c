#include "relievo/option_table.h"

#include <algorithm>
#include <set>

#include "support/results.h"

namespace relievo {
namespace {

void expect_defaults(const ReliefOptions& read) {
  const ReliefOptions options;
  EXPECT_EQ(read.width_mm, options.width_mm);
  EXPECT_EQ(read.method, options.method);
  EXPECT_EQ(read.mode, options.mode);
  EXPECT_EQ(read.view, options.view);
  EXPECT_EQ(read.outline, options.outline);
  EXPECT_EQ(read.base.kind, options.base.kind);
  EXPECT_EQ(read.wrap.kind, options.wrap.kind);
  EXPECT_EQ(read.form, options.form);
  EXPECT_EQ(read.finish, options.finish);
  EXPECT_FALSE(read.tone || read.tool);
}

TEST(ParseOptions, DefaultsAreThoseOfTheOptions) {
  OptionValues defaults;
  for (const OptionRow& option : option_table())
    if (option.initial != OptionValue()) defaults.emplace(option.name, option.initial);
  for (const OptionValues& values : {OptionValues(), defaults}) {
    const auto read = value_of(parse_options(values));
    expect_defaults(read);
    EXPECT_EQ(parse_depth(values)->range, DepthOptions{}.range);
  }
}

TEST(ParseOptions, EachBecomesItsValue) {
  const auto options = parse_options({{"height", 3.},
                                      {"points", 5000.},
                                      {"thickness", "1/8in"},
                                      {"method", "gradient"},
                                      {"mode", "auto"},
                                      {"view", "left"},
                                      {"up", "0,0,1"},
                                      {"outline", "hexagon"},
                                      {"wrap", "cone:turn=90"},
                                      {"form", "die"},
                                      {"tool", "ball:1/8in"},
                                      {"finish", "reachable"}});
  ASSERT_TRUE(options) << options.error().message();
  EXPECT_EQ(options->height_mm, 3);
  EXPECT_EQ(options->points, 5000);
  EXPECT_NEAR(*options->thickness_mm, 3.175, 1e-12);
  EXPECT_EQ(options->method, Method::gradient);
  EXPECT_EQ(options->mode, Mode::automatic);
  EXPECT_LT((options->view.R_view_model.row(2) - Vec3(-1, 0, 0).transpose()).norm(), 1e-12);
  EXPECT_LT((options->view.R_view_model.row(1) - Vec3(0, 0, 1).transpose()).norm(), 1e-12);
  EXPECT_EQ(options->outline, Outline::hexagon);
  EXPECT_EQ(options->wrap.kind, WrapKind::cone);
  EXPECT_EQ(options->wrap.turn_deg, 90);
  EXPECT_EQ(options->form, Form::die);
  EXPECT_NEAR(options->tool->diameter_mm, 3.175, 1e-12);
  EXPECT_EQ(options->finish, Finish::reachable);
  const auto others = parse_options({{"tone", "0,0.5;1,0.25"}, {"base", "wave:height=2"}, {"diameter", 30.}});
  ASSERT_TRUE(others) << others.error().message();
  EXPECT_EQ(others->tone->points().size(), 2U);
  EXPECT_EQ(others->base.height_mm, 2);
  EXPECT_EQ(others->outline, Outline::circle);
}

// Returns whether every text is a valid value of the option, such as a text for the plate or the name of a
// file.
bool is_any_text(const OptionRow& option) {
  return option.name == "text" || option.name == "font" || option.name == "ornaments";
}

TEST(ParseOptions, AWrongTextIsNamedWithoutDashes) {
  for (const OptionRow& option : option_table()) {
    if (option.is_number() || !option.is_of_relief() || is_any_text(option)) continue;
    const auto options = parse_options({{std::string(option.name), "nonsense"}});
    ASSERT_FALSE(options) << option.name;
    EXPECT_EQ(options.error().kind, ErrorKind::option) << option.name;
    EXPECT_EQ(options.error().input, option.name);
    EXPECT_TRUE(options.error().expected.starts_with("expected ")) << options.error().expected;
    EXPECT_TRUE(options.error().expected.contains("found 'nonsense'")) << option.name;
  }
}

TEST(ParseOptions, TellsWhatItExpected) {
  EXPECT_EQ(message_of(parse_options({{"finish", "polished"}})),
            "finish: expected one of full or reachable, found 'polished'");
  EXPECT_EQ(message_of(parse_options({{"rim", -1.}})),
            "rim: expected a number from 0.01 to 100000, found -1");
  EXPECT_EQ(message_of(parse_options({{"base", "wave"}, {"wrap", "sphere"}})),
            "wrap: expected either base or wrap, found both");
  EXPECT_EQ(message_of(parse_options({{"alpha", "4"}})), "alpha: expected a number");
  EXPECT_EQ(message_of(parse_options({{"view", 4.}})), "view: expected a text");
  EXPECT_EQ(message_of(parse_options({{"hight", 4.}})), "hight: expected the name of an option");
  EXPECT_TRUE(message_of(parse_options({{"width", "wide"}})).starts_with("width: expected"));
}

TEST(ParseDepth, ReadsAndChecksTheRowsOfDepthImages) {
  const auto options = value_of(parse_depth(
      {{"depth-values", "inverse"}, {"channel", 3.}, {"depth-range", 2.}, {"background", "keep"}}));
  EXPECT_EQ(options.values, DepthValues::inverse);
  EXPECT_EQ(options.range, 2);
  EXPECT_EQ(options.channel, 3);
  EXPECT_EQ(options.background, Removal::keep);
  EXPECT_EQ(parse_depth({{"depth-values", "auto"}})->values, DepthValues::automatic);
  EXPECT_EQ(message_of(parse_depth({{"depth-values", "far"}})),
            "depth-values: expected one of depth, height, inverse, luminance or auto, found 'far'");
  EXPECT_TRUE(message_of(parse_depth({{"background", "cut"}})).starts_with("background: "));
  EXPECT_EQ(message_of(parse_depth({{"depth-range", 11.}})),
            "depth-range: expected a number from 0.01 to 10, found 11");
  EXPECT_EQ(message_of(parse_depth({{"channel", 1.5}})), "channel: expected a whole number, found 1.5");
  EXPECT_EQ(message_of(parse_depth({{"channel", 65.}})), "channel: expected a number from 0 to 64, found 65");
}

TEST(ParseDoubtful, ReadsItsRowAlone) {
  EXPECT_FALSE(*parse_doubtful({{"height", 3.}}));
  EXPECT_FALSE(*parse_doubtful({{"doubtful", "drop"}}));
  EXPECT_TRUE(*parse_doubtful({{"doubtful", "keep"}}));
  EXPECT_EQ(message_of(parse_doubtful({{"doubtful", "maybe"}})),
            "doubtful: expected one of drop or keep, found 'maybe'");
}

TEST(OptionTable, HasNamesOfTheirOwnHelpAndADefault) {
  std::set<std::string_view> names;
  for (const OptionRow& option : option_table()) {
    EXPECT_TRUE(!option.name.empty() && names.insert(option.name).second) << option.name;
    EXPECT_FALSE(option.unit.empty()) << option.name;
    EXPECT_FALSE(option.help.empty()) << option.name;
    EXPECT_LT(option.min, option.max) << option.name;
    EXPECT_NE(option.access.read, nullptr) << option.name;
    const bool has_number = option.access.number && option.access.number(ReliefOptions{});
    EXPECT_TRUE(has_number || !option.otherwise.empty() || option.initial != OptionValue()) << option.name;
  }
}

// Every number in NumericOptions must have a row in the table, so that all numbers that users set are checked.
TEST(OptionTable, HasARowForEachNumber) {
  std::size_t bytes = 0;
  for (const OptionRow& option : option_table()) {
    if (!option.access.number || option.stage == OptionStage::view) continue;
    const bool may_be_missing = option.initial == OptionValue();
    bytes += may_be_missing ? sizeof(std::optional<double>) : sizeof(double);
  }
  EXPECT_EQ(sizeof(NumericOptions), bytes);
}

TEST(OptionTable, ChoicesAreWhatIsRead) {
  for (const OptionRow& option : option_table())
    for (const std::string_view choice : option.choices) {
      OptionValues values{{"height", 3.}, {"tool", "ball:1"}};
      if (option.name == "text-arc") values["text"] = "A";
      values[std::string(option.name)] = std::string(choice);
      EXPECT_EQ(message_of(parse_options(values)), "no error") << option.name << " " << choice;
      EXPECT_EQ(message_of(parse_depth(values)), "no error") << option.name << " " << choice;
    }
}

TEST(ParseOptions, CrumbsMayBeANumberOfPieces) {
  const auto view = [](const char* crumbs) { return parse_options({{"crumbs", crumbs}}).value().view; };
  EXPECT_EQ(view("largest").most_pieces, 1);
  EXPECT_EQ(view("12").most_pieces, 12);
  EXPECT_EQ(view("drop").most_pieces, 0);
  EXPECT_TRUE(view("keep").has_crumbs);
  for (const char* wrong : {"0", "-1", "1.5", "two", "2x", "1e9"})
    EXPECT_EQ(
        message_of(parse_options({{"crumbs", wrong}})),
        std::string("crumbs: expected drop, keep, largest or a number of pieces, found '") + wrong + "'");
}

}  // namespace
}  // namespace relievo
