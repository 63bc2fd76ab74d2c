#include <gtest/gtest.h>

#include <array>

#include "relievo/scan/view.h"
#include "support/shapes.h"

namespace relievo {
namespace {

// One face of the slab is carved. The view of this face must be the best one.
TEST(ViewRanking, RanksTheCarvedSideFirst) {
  const Cloud slab = test::height_field(
      20000, 1, [](double x, double y) { return .1 * std::sin(9 * x) * std::sin(9 * y); },
      [](double x, double y) {
        return Vec2(.9 * std::cos(9 * x) * std::sin(9 * y), .9 * std::sin(9 * x) * std::cos(9 * y));
      });
  const Cloud back = test::inside_out(test::sheet(20000, 1, -.3));
  EXPECT_EQ(rank_views(test::joined(slab, back))[0].name, "front");
}

// Returns a part of a sphere, as if scanned from +Z: without its back.
Cloud dome() {
  return test::where(test::sphere(40000, 1), [](const Vec3& p) { return p.z() > .3; });
}

// Rotates a cloud. If `has_normals` is false, removes the normals.
Cloud mapped(const Cloud& cloud, const Mat3& turn, bool has_normals = true) {
  Cloud out = cloud;
  for (Vec3& p : out.points) p = turn * p;
  for (Vec3f& n : out.normals) n = turn.cast<float>() * n;
  if (!has_normals) out.normals.clear();
  return out;
}

Mat3 z_to(const Vec3& axis) {
  Mat3 turn;
  turn << axis.unitOrthogonal(), axis.cross(axis.unitOrthogonal()), axis;
  return turn;
}

TEST(ViewRanking, PrefersTheScannedSideToItsHollowBack) {
  const std::array<std::pair<std::string_view, Vec3>, 6> sides{{{"front", {0, 0, 1}},
                                                                {"back", {0, 0, -1}},
                                                                {"left", {-1, 0, 0}},
                                                                {"right", {1, 0, 0}},
                                                                {"top", {0, 1, 0}},
                                                                {"bottom", {0, -1, 0}}}};
  for (const auto& [name, towards] : sides)
    for (const bool has_normals : {true, false}) {
      const auto ranked = rank_views(mapped(dome(), z_to(towards), has_normals));
      EXPECT_EQ(ranked[0].name, name) << has_normals;
      EXPECT_EQ(ranked[0].up, "");
      EXPECT_EQ(ranked[5].score, 0) << has_normals;
    }
}

TEST(ViewRanking, DoesNotMindNormalsThatPointInwards) {
  const Cloud low = test::where(test::sphere(20000, 1, 2), [](const Vec3& p) { return p.z() <= .3; });
  const Cloud outward = test::joined(dome(), low);
  const auto outward_first = rank_views(outward), inward_first = rank_views(test::inside_out(outward));
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(inward_first[i].name, outward_first[i].name);
}

// Returns a tall round column with a foot that is wider than the rest. It looks the same from all directions
// perpendicular to `up`.
Cloud column(const Vec3& up) {
  test::Random random(7);
  Cloud cloud;
  const Vec3 x = up.unitOrthogonal(), y = up.cross(x);
  for (int i = 0; i < 60000; ++i) {
    const double h = random.uniform(0, 6), angle = random.uniform(0, 2 * std::numbers::pi);
    const double radius = .6 + .1 * std::sin(9 * h) + .6 * std::exp(-3 * h);
    const double slope = .9 * std::cos(9 * h) - 1.8 * std::exp(-3 * h);
    const Vec3 outwards = std::cos(angle) * x + std::sin(angle) * y;
    test::add(cloud, h * up + radius * outwards, outwards - slope * up);
  }
  return cloud;
}

TEST(ViewRanking, ShowsWhatStandsOnItsFootUpright) {
  EXPECT_EQ(rank_views(column(Vec3::UnitY()))[0].name, "front");
  EXPECT_EQ(rank_views(column(Vec3::UnitZ()))[0].name, "bottom");
  EXPECT_EQ(rank_views(column(-Vec3::UnitY()))[0].name, "back");
  EXPECT_EQ(rank_views(column(-Vec3::UnitY()))[0].up, "0,-1,0");
  for (const ViewGuess& side : rank_views(column(Vec3::UnitZ()))) {
    const bool is_seen_from_above = side.name == "front" || side.name == "back";
    const View view = *parse_view(side.name, side.up);
    const double up_in_view = (view.R_view_model * Vec3::UnitZ()).y();
    EXPECT_NEAR(up_in_view, is_seen_from_above ? 0 : 1, 1e-12) << side.name;
  }
}

}  // namespace
}  // namespace relievo
