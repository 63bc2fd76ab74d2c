// Tests that material is coloured only where a tool leaves it.

#include <gtest/gtest.h>

#include "picture/shading.h"

namespace relievo {
namespace {

// Returns the reach of a tool on a front of 20 mm x 10 mm, in samples of 1 mm. On the left half the tool
// leaves nothing. On the right half it leaves 1 mm of material in the top row, and 0.1 mm in the other rows.
std::shared_ptr<const ToolReach> reach() {
  ToolReach reach{.largest_residual_mm = 1,
                  .tolerance_mm = .01,
                  .mm_per_sample = 1,
                  .residual_mm = filled_image(20, 10, 0.F)};
  for (int y = 0; y < 10; ++y)
    for (int x = 10; x < 20; ++x) reach.residual_mm.at(x, y) = y == 0 ? 1.F : .1F;
  return std::make_shared<const ToolReach>(std::move(reach));
}

Box front() {
  Box box;
  box.extend(Vec3(-10, -5, 0));
  box.extend(Vec3(10, 5, 2));
  return box;
}

const Vec3f grey(.5F, .5F, .5F);

TEST(ReachTint, ColoursWhatIsLeft) {
  const ReachTint tint(reach(), front());
  EXPECT_EQ(tint(grey, {-5, 0, 1}), grey);
  EXPECT_EQ(tint(grey, {-.1F, 4.9F, 1}), grey);
  const Vec3f little = tint(grey, {5, 0, 1}), much = tint(grey, {5, 4.9F, 1});
  EXPECT_GT(little.x(), 1.2F * little.y());  // orange
  EXPECT_GT(little.y(), 1.5F * little.z());
  EXPECT_GT(much.x(), 3 * much.y());  // red
}

TEST(ReachTint, ColoursNothingBesideTheFrontNorWithoutAReach) {
  const ReachTint tint(reach(), front());
  EXPECT_EQ(tint(grey, {10.5F, 0, 1}), grey);
  EXPECT_EQ(tint(grey, {5, 5.5F, 1}), grey);
  EXPECT_EQ(ReachTint(nullptr, front())(grey, {5, 0, 1}), grey);
  EXPECT_EQ(ReachTint(std::make_shared<const ToolReach>(), front())(grey, {5, 0, 1}), grey);
}

}  // namespace
}  // namespace relievo
