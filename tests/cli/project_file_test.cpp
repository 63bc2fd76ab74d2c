#include "common/project_file.h"

#include "common/read_inputs.h"
#include "support/cli_folder.h"
#include "support/results.h"

namespace relievo {
namespace {

using PackOrnaments = test::CliFolder;

TEST_F(PackOrnaments, TakesAListAloneAndInAnObject) {
  test::write_all(folder_ / "crest.svg", R"(<svg viewBox="0 0 9 9"><path d="M0 0H9V9H0Z"/></svg>)");
  const std::string file = (folder_ / "crest.svg").string();
  const std::string list = R"([{"kind":"drawing","file":")" + file + R"("}])";
  for (std::string ornaments : {list, R"({"ornaments":)" + list + "}"}) {
    const app::OrnamentFiles files = value_of(app::pack_ornaments(nullptr, &ornaments));
    ASSERT_EQ(files.size(), 1) << ornaments;
    EXPECT_TRUE(ornaments.contains(files.begin()->first)) << ornaments;
    EXPECT_FALSE(ornaments.contains(file)) << ornaments;
  }
}

OptionValues values(std::initializer_list<std::pair<const std::string, OptionValue>> all) {
  return {all.begin(), all.end()};
}

// Given options replace the project's values of the same options. The project's options that the given ones
// exclude are dropped.
TEST(ProjectOptions, GiveWayToTheirAlternatives) {
  const OptionValues paper = values({{"alpha", 10.}, {"method", "paper"}, {"width", 50.}}),
                     scale = values({{"mm-per-value", 5.}, {"ground", 2.}, {"method", "linear"}}),
                     high = values({{"height", 3.}, {"method", "layered"}}),
                     plate = values({{"plate", "80x60"}, {"outline", "rectangle"}}),
                     coin = values({{"diameter", 60.}, {"outline", "circle"}});
  for (const auto& given :
       {values({{"height", 4.}}), values({{"height-of-diagonal", .1}}), values({{"alpha", 5.}}),
        values({{"mm-per-value", 2.}}), values({{"mm-per-value", 2.}, {"ground", 1.}, {"method", "linear"}}),
        values({{"method", "layered"}}), values({{"diameter", 70.}}), values({{"plate", "90x70"}}),
        values({{"diameter", 70.}, {"outline", "circle"}}),
        values({{"plate", "90x70"}, {"outline", "round"}})})
    for (const OptionValues& own : {paper, scale, high, plate, coin}) {
      const OptionValues all = app::with_given(own, given);
      const auto options = parse_options(all);
      EXPECT_TRUE(options) << options.error().message() << " with " << given.begin()->first << " on "
                           << own.begin()->first;
      for (const auto& [name, value] : given) EXPECT_EQ(all.at(name), value);
    }
  EXPECT_EQ(app::with_given(paper, values({{"height", 4.}})).at("width"), OptionValue(50.));
  EXPECT_EQ(app::with_given(values({{"ground", 3.}}), {}).at("ground"), OptionValue(3.));
  EXPECT_EQ(app::with_given(scale, values({{"ground", 3.}})).at("mm-per-value"), OptionValue(5.));
}

}  // namespace
}  // namespace relievo
