#include "common/project.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace relievo::app {
namespace {

TEST(Project, FormerNamesOfOptionsAreReadAndNoLongerWritten) {
  const auto project = read_project(
      R"({"relievo": 1, "input": {"sample": "shell"},
          "options": {"surface": "reachable", "method": "ours"}})",
      "p");
  ASSERT_TRUE(project) << project.error().message();
  EXPECT_EQ(project->options.finish, "reachable");
  EXPECT_EQ(project->options.method, "layered");
  const nlohmann::json written = to_json(project->options);
  EXPECT_EQ(written["finish"], "reachable");
  EXPECT_EQ(written["method"], "layered");
  EXPECT_FALSE(written.contains("surface"));
}

TEST(Project, AFormerNameTakesNoOtherType) {
  const auto texts = texts_from_json({{"surface", 3}}, "p");
  ASSERT_FALSE(texts);
  EXPECT_EQ(texts.error().message(), "p, options.finish: expected a text, found 3");
}

}  // namespace
}  // namespace relievo::app
