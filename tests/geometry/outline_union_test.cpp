#include "geometry/outline_union.h"

#include <gtest/gtest.h>

#include <random>

#include "geometry/plane.h"

namespace relievo {
namespace {

std::vector<Vec2> rectangle(double x, double y, double width, double height) {
  return {{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}};
}

double length_of(const std::vector<Segment>& sides) {
  double length = 0;
  for (const Segment& s : sides) length += (s.to - s.from).norm();
  return length;
}

double area_of(const std::vector<Segment>& sides) {
  double twice = 0;
  for (const Segment& s : sides) twice += cross(s.from, s.to);
  return twice / 2;
}

TEST(OutlineUnion, OfOverlappingSquaresHasTheirArea) {
  const std::vector<Segment> sides = union_boundary({rectangle(0, 0, 2, 2), rectangle(1, 1, 2, 2)});
  EXPECT_NEAR(area_of(sides), 7, 1e-9);
  EXPECT_NEAR(length_of(sides), 12, 1e-9);
}

TEST(OutlineUnion, LeavesOutTheSideBetweenNeighbours) {
  std::vector<Vec2> clockwise = rectangle(1, 0, 1, 1);
  const std::vector<Segment> sides = union_boundary({rectangle(0, 0, 1, 1), clockwise});
  EXPECT_NEAR(length_of(sides), 6, 1e-9);
  EXPECT_NEAR(area_of(sides), 2, 1e-9);
}

TEST(OutlineUnion, OfBarsAlongOneLineIsOneBar) {
  const std::vector<Segment> sides =
      union_boundary({rectangle(0, 0, 3, 1), rectangle(2, 0, 3, 1), rectangle(4.5, 0, 2, 1)});
  EXPECT_NEAR(area_of(sides), 6.5, 1e-9);
  EXPECT_NEAR(length_of(sides), 15, 1e-9);
}

TEST(OutlineUnion, KeepsHolesAndFillsThemIfTheyTurnTheSameWay) {
  std::vector<Vec2> hole = rectangle(1, 1, 1, 1);
  EXPECT_NEAR(area_of(union_boundary({rectangle(0, 0, 3, 3), hole})), 9, 1e-9);
  std::ranges::reverse(hole);
  EXPECT_NEAR(area_of(union_boundary({rectangle(0, 0, 3, 3), hole})), 8, 1e-9);
}

TEST(OutlineUnion, CoversTheSamePlaces) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(0, 1);
  Outlines outlines(5);
  for (std::vector<Vec2>& outline : outlines)
    for (int k = 0; k < 7; ++k) {
      const double x = place(random);
      outline.emplace_back(x, place(random));
    }
  const std::vector<Segment> sides = union_boundary(outlines);
  const SegmentGrid grid(sides, .1);
  int inside = 0;
  for (int k = 0; k < 2000; ++k) {
    const double x = place(random);
    const Vec2 p(x, place(random));
    const NearestSegment near = grid.nearest(p, 2);
    if (near.distance < 1e-5) continue;
    const bool is_covered = winding_number(outlines, p) != 0;
    EXPECT_EQ(near.is_left, is_covered) << p.transpose();
    inside += is_covered;
  }
  EXPECT_GT(inside, 100);
}

}  // namespace
}  // namespace relievo
