// Tests that options without an effect are told, by making reliefs with and without them.
#include <set>

#include "relievo/make_relief.h"
#include "relievo/option_table.h"
#include "relievo/relief/relief.h"
#include "support/results.h"
#include "support/shapes.h"

namespace relievo {
namespace {

const ReliefModel& coloured_model() {
  static const ReliefModel made = [] {
    Cloud cloud = test::joined(test::torus(3000, 1.5, .4), test::sphere(2000, .8));
    for (std::size_t i = 0; i < cloud.points.size(); ++i)
      cloud.colours.push_back(i % 3 == 0 ? Colour{0, 0, 0} : Colour{255, 255, 255});
    return value_of(prepare(cloud, View{}));
  }();
  return made;
}

// Returns a value that differs from the option's default.
OptionValue other_value(const OptionRow& option) {
  if (option.name == "tone") return "0,0;0.4,0.7;1,1";
  if (option.name == "light") return "45,30";
  if (option.name == "strokes")
    return R"([{"brush":"strengthen","amount":2,"radius":0.5,"points":[[0,0,0.8]]}])";
  return option.min + .3 * (std::min(option.max, 2.) - option.min);
}

bool is_listed(const ReliefOptions& options, std::string_view name) {
  return std::ranges::count(idle_options(options), name, &IdleOption::name) == 1;
}

// Options of the shape that contradict others, or need another model, are refused and need no remark.
TEST(IdleOptions, OfALithophaneAreThoseThatLeaveItsBytes) {
  ReliefOptions plain;
  plain.form = Form::lithophane;
  const auto points = value_of(make_relief(coloured_model(), plain)).solid.points;
  std::set<std::string_view> refused;
  for (const OptionRow& option : option_table()) {
    if (option.stage != OptionStage::shape) continue;
    const auto options =
        parse_options({{"form", "lithophane"}, {std::string(option.name), other_value(option)}});
    const auto made = options ? make_relief(coloured_model(), *options) : std::unexpected(options.error());
    if (!made)
      refused.insert(option.name);
    else
      EXPECT_EQ(is_listed(*options, option.name), made->solid.points == points) << option.name;
  }
  EXPECT_EQ(refused, (std::set<std::string_view>{"alpha", "ground", "mm-per-value"}));
}

TEST(IdleOptions, NameTheOptionThatIsMissing) {
  EXPECT_TRUE(idle_options({}).empty());
  ReliefOptions options{{.light_contrast = .5, .corner_mm = 2}};
  EXPECT_TRUE(is_listed(options, "corner"));
  EXPECT_TRUE(is_listed(options, "light-contrast"));
  EXPECT_EQ(value_of(make_relief(coloured_model(), options)).report.idle_options.size(), 2U);
  options.outline = Outline::round;
  options.light = LightDirection{};
  EXPECT_TRUE(idle_options(options).empty());
  options = {{.alpha = 3, .saturation = 0}};
  EXPECT_TRUE(is_listed(options, "alpha"));
}

}  // namespace
}  // namespace relievo
