#include "geometry/segment_grid.h"

#include <gtest/gtest.h>

#include <numbers>

#include "geometry/plane.h"
#include "support/planar_points.h"

namespace relievo {
namespace {

std::vector<Segment> random_segments(std::size_t n) {
  const std::vector<Vec2> from = random_points(n, 3), step = random_points(n, 4);
  std::vector<Segment> segments;
  for (std::size_t i = 0; i < n; ++i)
    segments.push_back({from[i], from[i] + .1 * (step[i] - Vec2(.5, .5)), static_cast<Index>(i % 7)});
  return segments;
}

double distance(const Segment& s, const Vec2& p) {
  const Vec2 step = s.to - s.from;
  const double share = std::clamp((p - s.from).dot(step) / step.squaredNorm(), 0.0, 1.0);
  return (p - s.from - share * step).norm();
}

TEST(SegmentGrid, NearestAgreesWithBruteForce) {
  const std::vector<Segment> segments = random_segments(300);
  const SegmentGrid grid(segments, .03);
  for (const Vec2& p : random_points(500, 5)) {
    double least = .05;
    for (const Segment& s : segments)
      if (s.curve != 2) least = std::min(least, distance(s, p));
    const NearestSegment found = grid.nearest(p, .05, 2);
    ASSERT_EQ(found.segment == no_index, least == .05);
    if (found.segment != no_index) EXPECT_DOUBLE_EQ(found.distance, least);
  }
}

TEST(SegmentGrid, CrossingsAgreeWithBruteForce) {
  const std::vector<Segment> segments = random_segments(100);
  const SegmentGrid grid(segments, .04);
  const std::vector<Vec2> a = random_points(1000, 6), b = random_points(1000, 8);
  LinesFrom lines;
  int crossed = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vec2 to = a[i] + .2 * (b[i] - a[i]);
    bool expected = false;
    for (const Segment& s : segments) {
      const Vec2 u = to - a[i], v = s.to - s.from;
      const double at = cross(s.from - a[i], v) / cross(u, v), on = cross(s.from - a[i], u) / cross(u, v);
      expected |= at > 0 && at < 1 && on > 0 && on < 1;
    }
    crossed += expected;
    EXPECT_EQ(grid.is_crossed(a[i], to), expected);
    lines.begin(grid, a[i], .3);
    EXPECT_EQ(lines.is_crossed(to), expected);
    EXPECT_FALSE(lines.is_crossed(a[i]));
  }
  EXPECT_GT(crossed, 100);
}

TEST(SegmentGrid, KnowsTheSideAlsoBesideCorners) {
  std::vector<Segment> star;  // a closed curve with acute corners; its inside is on its left
  const auto at = [](int i) {
    const double angle = std::numbers::pi * i / 5;
    return Vec2((i % 2 ? .3 : 1) * Vec2(std::cos(angle), std::sin(angle)));
  };
  for (int i = 0; i < 10; ++i) star.push_back({at(i), at(i + 1), 0});
  const SegmentGrid grid(star, .1);
  for (const Vec2& unit : random_points(2000, 9)) {
    const Vec2 p = 2.4 * (unit - Vec2(.5, .5));
    bool is_inside = false;  // whether a ray to the right crosses the curve an odd number of times
    for (const Segment& s : star) {
      if ((s.from.y() > p.y()) == (s.to.y() > p.y())) continue;
      is_inside ^=
          s.from.x() + (p.y() - s.from.y()) / (s.to.y() - s.from.y()) * (s.to.x() - s.from.x()) > p.x();
    }
    EXPECT_EQ(grid.nearest(p, 10).is_left, is_inside);
  }
}

TEST(SegmentGrid, WithoutSegmentsFindsNothing) {
  const SegmentGrid grid({}, 1);
  EXPECT_EQ(grid.nearest({0, 0}, 5).segment, no_index);
  EXPECT_FALSE(grid.is_crossed({0, 0}, {1, 1}));
}

}  // namespace
}  // namespace relievo
