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

}  // namespace
}  // namespace relievo
