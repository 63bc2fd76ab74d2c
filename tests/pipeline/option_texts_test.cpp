#include "relievo/option_texts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace relievo {
namespace {

std::string complaint(const OptionTexts& texts) {
  const auto options = parse_options(texts);
  return options ? "" : options.error().message();
}

TEST(OptionTexts, DefaultsAreThoseOfTheOptions) {
  const auto parsed = parse_options({});
  ASSERT_TRUE(parsed) << parsed.error().message();
  const ReliefOptions options;
  EXPECT_EQ(parsed->width_mm, options.width_mm);
  EXPECT_EQ(parsed->method, options.method);
  EXPECT_EQ(parsed->mode, options.mode);
  EXPECT_EQ(parsed->view.R_view_model, options.view.R_view_model);
  EXPECT_EQ(parsed->outline, options.outline);
  EXPECT_EQ(parsed->base.kind, options.base.kind);
  EXPECT_EQ(parsed->wrap.kind, options.wrap.kind);
  EXPECT_EQ(parsed->form, options.form);
  EXPECT_EQ(parsed->finish, options.finish);
  EXPECT_FALSE(parsed->tone || parsed->tool);
}

TEST(OptionTexts, EachBecomesItsValue) {
  OptionTexts texts;
  texts.height_mm = 3;
  texts.points = 5000;
  texts.method = "gradient";
  texts.mode = "auto";
  texts.view = "left";
  texts.up = "0,0,1";
  texts.outline = "hexagon";
  texts.wrap = "cone:turn=90";
  texts.form = "die";
  texts.tool = "ball:1/8in";
  texts.finish = "reachable";
  const auto options = parse_options(texts);
  ASSERT_TRUE(options) << options.error().message();
  EXPECT_EQ(options->height_mm, 3);
  EXPECT_EQ(options->points, 5000);
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
  texts = {};
  texts.tone = "0,0.5;1,0.25";
  texts.base = "wave:height=2";
  EXPECT_EQ(parse_options(texts)->tone->points().size(), 2U);
  EXPECT_EQ(parse_options(texts)->base.height_mm, 2);
}

TEST(OptionTexts, AWrongOneIsNamedWithoutDashes) {
  const std::pair<std::string OptionTexts::*, std::string> texts[] = {
      {&OptionTexts::method, "method"},   {&OptionTexts::tone, "tone"}, {&OptionTexts::mode, "mode"},
      {&OptionTexts::view, "view"},       {&OptionTexts::up, "up"},     {&OptionTexts::base, "base"},
      {&OptionTexts::outline, "outline"}, {&OptionTexts::wrap, "wrap"}, {&OptionTexts::form, "form"},
      {&OptionTexts::finish, "finish"},   {&OptionTexts::tool, "tool"}};
  for (const auto& [member, name] : texts) {
    OptionTexts wrong;
    wrong.*member = "nonsense";
    const auto options = parse_options(wrong);
    ASSERT_FALSE(options) << name;
    EXPECT_EQ(options.error().kind, ErrorKind::option) << name;
    EXPECT_EQ(options.error().input, name);
    EXPECT_TRUE(options.error().expected.starts_with("expected ")) << options.error().expected;
    EXPECT_NE(options.error().expected.find("found 'nonsense'"), std::string::npos) << name;
  }
  OptionTexts wrong;
  wrong.finish = "polished";
  EXPECT_EQ(complaint(wrong), "finish: expected one of full or reachable, found 'polished'");
  wrong = {};
  wrong.rim_mm = -1;
  EXPECT_EQ(complaint(wrong), "rim: expected a number from 0.01 to 100000, found -1");
  wrong = {};
  wrong.base = "wave";
  wrong.wrap = "sphere";
  EXPECT_EQ(complaint(wrong), "wrap: expected either base or wrap, found both");
}

TEST(OptionFields, HaveNamesOfTheirOwnHelpAndADefault) {
  std::set<std::string_view> names;
  for (const ReliefField& field : option_fields()) {
    EXPECT_TRUE(!field.name.empty() && names.insert(field.name).second) << field.name;
    EXPECT_FALSE(field.unit.empty()) << field.name;
    EXPECT_FALSE(field.help.empty()) << field.name;
    EXPECT_LT(field.min, field.max) << field.name;
    const bool may_be_missing = std::holds_alternative<std::optional<double> NumericOptions::*>(field.value);
    EXPECT_TRUE(!may_be_missing || field.effective || !field.otherwise.empty()) << field.name;
  }
}

// All members are in the table: none can be typed that is not checked.
TEST(OptionFields, AreAllMembers) {
  const auto count = [](const auto is) {
    return static_cast<std::size_t>(std::ranges::count_if(option_fields(), is));
  };
  const std::size_t texts = count([](const ReliefField& field) {
    return std::holds_alternative<std::string OptionTexts::*>(field.value);
  });
  const std::size_t numbers = count(
      [](const ReliefField& field) { return std::holds_alternative<double NumericOptions::*>(field.value); });
  const std::size_t all = option_fields().size();
  EXPECT_EQ(sizeof(NumericOptions),
            numbers * sizeof(double) + (all - numbers - texts) * sizeof(std::optional<double>));
  const std::size_t unpadded = sizeof(NumericOptions) + texts * sizeof(std::string);
  constexpr std::size_t padding = alignof(OptionTexts);
  EXPECT_EQ(sizeof(OptionTexts), (unpadded + padding - 1) / padding * padding);
}

TEST(OptionFields, ChoicesAreWhatIsRead) {
  for (const ReliefField& field : option_fields())
    for (const std::string_view choice : field.choices) {
      OptionTexts texts;
      texts.height_mm = 3;
      texts.tool = "ball:1";
      texts.*std::get<std::string OptionTexts::*>(field.value) = choice;
      EXPECT_EQ(complaint(texts), "") << field.name << " " << choice;
    }
}

}  // namespace
}  // namespace relievo
