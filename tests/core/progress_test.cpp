#include "relievo/core/progress.h"

#include "support/results.h"

namespace relievo {
namespace {

TEST(Progress, TellsItsWatcherOfEachStageAndNeverGoesBack) {
  std::vector<std::pair<std::string, double>> seen;
  Progress progress([&](std::string_view stage, double fraction) { seen.emplace_back(stage, fraction); });
  EXPECT_TRUE(progress.stage("first", .4));
  EXPECT_TRUE(progress.stage("second", .2));
  EXPECT_TRUE(progress.stage("third", 7));
  progress.finish();
  EXPECT_EQ(seen, (std::vector<std::pair<std::string, double>>{
                      {"first", .4}, {"second", .4}, {"third", 1}, {"done", 1}}));
}

TEST(Progress, RecordsTheTimeOfStagesThatHaveEnded) {
  Progress progress;
  EXPECT_TRUE(progress.stage("first", 0));
  EXPECT_TRUE(progress.times().empty());
  EXPECT_TRUE(progress.stage("second", .5));
  progress.finish();
  ASSERT_EQ(progress.times().size(), 2U);
  EXPECT_EQ(progress.times()[0].name, "first");
  EXPECT_EQ(progress.times()[1].name, "second");
  EXPECT_GE(progress.times()[0].seconds, 0);
}

TEST(Progress, BeginsNoStageOnceCancelled) {
  Cancelled progress;
  expect_error(begin_stage(&progress, "first", 0), ErrorKind::cancelled);
  EXPECT_TRUE(begin_stage(nullptr, "first", 0));
}

}  // namespace
}  // namespace relievo
