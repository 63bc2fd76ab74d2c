#include "paper/mapping.h"

#include <gtest/gtest.h>

#include "support/planar_points.h"

namespace relievo::paper {
namespace {

float dome(const Vec2& p) {
  return static_cast<float>(1 + p.x() * (1 - p.x()) + p.y());
}

struct Mapped {
  std::vector<Vec2> control = random_points(400, 2), visible = random_points(3000, 5);

  // Returns the mapped heights at the visible points. At the control points the compressed heights are
  // ratio(p) times the uncompressed ones, which form a dome.
  template <typename F>
  std::vector<float> heights(F&& ratio) const {
    HeightMapping::Uncompressed uncompressed;
    std::vector<float> compressed, mapped(visible.size());
    for (const Vec2& p : control)
      uncompressed.control.push_back(dome(p)), compressed.push_back(ratio(p) * dome(p));
    for (const Vec2& p : visible) uncompressed.visible.push_back(dome(p));
    const HeightMapping mapping(control, visible, uncompressed);
    auto workspace = mapping.make_workspace();
    mapping.carry(compressed, workspace, mapped);
    return mapped;
  }
};

// The ratio is damped at heights below 2 % of the largest height, because it is not well defined there. Here
// the lowest height is 40 % of the largest one, so damping causes an error of only 0.25 %.
TEST(PaperMapping, KeepsARatioThatIsTheSameEverywhere) {
  const Mapped m;
  const std::vector<float> mapped = m.heights([](const Vec2&) { return .3F; });
  for (std::size_t i = 0; i < mapped.size(); ++i) EXPECT_NEAR(mapped[i], .3F * dome(m.visible[i]), .003F);
}

TEST(PaperMapping, CarriesASmoothRatio) {
  const Mapped m;
  const auto ratio = [](const Vec2& p) {
    return static_cast<float>(.5 + .2 * std::sin(3 * p.x() + 2 * p.y()));
  };
  const std::vector<float> mapped = m.heights(ratio);
  double sum = 0;
  for (std::size_t i = 0; i < mapped.size(); ++i) {
    const double error = mapped[i] - ratio(m.visible[i]) * dome(m.visible[i]);
    sum += error * error / static_cast<double>(mapped.size());
  }
  EXPECT_LT(std::sqrt(sum), .02);
}

// Because the ratio is undefined at z0 = 0, it is multiplied by z0^2 / (z0^2 + f^2), where f is 2 % of the largest
// height. So the result must be 0 wherever z0 is 0, and must nowhere be wrong by more than 10 % of the largest height.
TEST(PaperMapping, PassesZeroWhereTheUncompressedHeightsDo) {
  const Mapped m;
  const auto slope = [](const Vec2& p) { return static_cast<float>(p.x() - .5); };
  HeightMapping::Uncompressed uncompressed;
  std::vector<float> compressed, mapped(m.visible.size());
  for (const Vec2& p : m.control)
    uncompressed.control.push_back(slope(p)), compressed.push_back(.4F * slope(p));
  for (const Vec2& p : m.visible) uncompressed.visible.push_back(slope(p));
  const HeightMapping mapping(m.control, m.visible, uncompressed);
  auto workspace = mapping.make_workspace();
  mapping.carry(compressed, workspace, mapped);
  for (std::size_t i = 0; i < mapped.size(); ++i) {
    EXPECT_NEAR(mapped[i], .4F * slope(m.visible[i]), .02F);
    EXPECT_GE(mapped[i] * slope(m.visible[i]), 0);
  }
}

TEST(PaperMapping, OfFlatHeightsIsFlat) {
  const Mapped m;
  const HeightMapping mapping(
      m.control, m.visible,
      {std::vector<float>(m.control.size(), 0), std::vector<float>(m.visible.size(), 0)});
  auto workspace = mapping.make_workspace();
  std::vector<float> mapped(m.visible.size(), 7);
  mapping.carry(std::vector<float>(m.control.size(), 0), workspace, mapped);
  for (const float z : mapped) EXPECT_EQ(z, 0);
}

}  // namespace
}  // namespace relievo::paper
