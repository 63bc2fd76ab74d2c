#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scan/outlines/outlines.h"

namespace relievo {
namespace {

constexpr double rho = .1, spacing = .75 * rho, length = 3;
const Vec2 along = Vec2(3, 4).normalized(), left(-along.y(), along.x());

// Returns a straight jump of fixed length that begins at `begin`.
OutlineCurve jump(const Vec2& begin, const Vec2& direction) {
  OutlineCurve line{{}, false, true};
  for (double at = 0; at < length; at += spacing) line.curve.points.push_back(begin + at * direction);
  line.curve.is_corner.resize(line.curve.points.size(), 0);
  return line;
}

// Returns two jumps. The second jump begins at the distance `gap` beyond the end of the first, and its
// direction differs by the angle `turn`.
std::vector<OutlineCurve> two_jumps(double gap, double turn = 0, bool is_turned_round = false) {
  const OutlineCurve first = jump(Vec2::Zero(), along);
  OutlineCurve second =
      jump(first.curve.points.back() + gap * along, std::cos(turn) * along + std::sin(turn) * left);
  if (is_turned_round) std::ranges::reverse(second.curve.points);
  return {second, first};
}

std::size_t count_after_joining(std::vector<OutlineCurve> outlines) {
  join_jumps(outlines, rho);
  return outlines.size();
}

TEST(JoinedJumps, AreOneEvenLineAcrossTheGap) {
  std::vector<OutlineCurve> outlines = two_jumps(3.5 * rho);
  const Vec2 begin = outlines[1].curve.points.front(), end = outlines[0].curve.points.back();
  join_jumps(outlines, rho);
  ASSERT_EQ(outlines.size(), 1);
  EXPECT_TRUE(outlines[0].is_jump && !outlines[0].is_closed);
  const std::vector<Vec2>& points = outlines[0].curve.points;
  ASSERT_EQ(points.size(), outlines[0].curve.is_corner.size());
  EXPECT_LT((points.front() - begin).norm(), .001 * rho);
  EXPECT_LT((points.back() - end).norm(), .001 * rho);
  for (std::size_t k = 1; k < points.size(); ++k) {
    EXPECT_NEAR((points[k] - points[k - 1]).dot(along), spacing, .02 * rho);
    EXPECT_NEAR(left.dot(points[k]), 0, 1e-6);
  }
}

TEST(JoinedJumps, StayApartUnlessTheyContinueEachOther) {
  EXPECT_EQ(count_after_joining(two_jumps(4.5 * rho)), 2) << "too far apart";
  EXPECT_EQ(count_after_joining(two_jumps(2 * rho, 1.3)), 2) << "another direction";
  EXPECT_EQ(count_after_joining(two_jumps(2 * rho, 0, true)), 2) << "the front on the other side";
  std::vector<OutlineCurve> silhouettes = two_jumps(2 * rho);
  for (OutlineCurve& each : silhouettes) each.is_jump = false;
  EXPECT_EQ(count_after_joining(silhouettes), 2) << "no jumps";
}

// Three pieces of a ring must be joined to one line. The two ends of this line must not be joined to each other.
TEST(JoinedJumps, LeaveARingOpenAtOnePlace) {
  constexpr int pieces = 3;
  std::vector<OutlineCurve> outlines;
  const double radius = 30 * rho, step = spacing / radius;
  for (int piece = 0; piece < pieces; ++piece) {
    OutlineCurve arc{{}, false, true};
    const double turn = 2 * std::acos(-1.) / pieces, from = piece * turn, gap = 3 * rho / radius;
    for (double at = from; at < from + turn - gap; at += step)
      arc.curve.points.push_back(radius * Vec2(std::cos(at), std::sin(at)));
    arc.curve.is_corner.resize(arc.curve.points.size(), 0);
    outlines.push_back(arc);
  }
  join_jumps(outlines, rho);
  ASSERT_EQ(outlines.size(), 1);
  for (const Vec2& p : outlines[0].curve.points) EXPECT_NEAR(p.norm(), radius, .1 * rho);
}

}  // namespace
}  // namespace relievo
