#include "geometry/slope_limit.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <vector>

#include "support/shapes.h"

namespace relievo {
namespace {

// Two thin triangles (needles) that share a short edge. The points are first the two ends of the edge, then
// the far corner of each triangle.
struct Needles {
  std::array<Vec3, 4> points;
  std::vector<Triangle> triangles{{0, 1, 2}, {1, 0, 3}};
};

// Computes the slope of a triangle by definition, from its normal.
double steepness_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 p = b - a, q = c - a;
  return std::hypot(p.y() * q.z() - p.z() * q.y(), p.z() * q.x() - p.x() * q.z()) /
         (p.x() * q.y() - p.y() * q.x());
}

double steepest(const Needles& needles) {
  double most = 0;
  for (const auto& [a, b, c] : needles.triangles)
    most = std::max(most, steepness_of(needles.points[a], needles.points[b], needles.points[c]));
  return most;
}

double rise_of(const Needles& needles) {
  return Box::of(needles.points).size().z();
}

Needles stored(Needles needles) {
  // The floats are stored in an array first, because g++ 12 drops the rounding of double(float(x)) when it vectorises.
  std::vector<Vec3f> points;
  for (const Vec3& p : needles.points) points.push_back(p.cast<float>());
  for (std::size_t i = 0; i < 4; ++i) needles.points[i] = points[i].cast<double>();
  return needles;
}

// The needles after limit_slopes(), and the largest distance by which a point moved. The distance is
// infinity if a needle is still too steep.
struct Flattened {
  Needles needles;
  double largest_move = std::numeric_limits<double>::infinity();
};

Flattened flattened(const Needles& given, Rounding rounding) {
  std::vector<Vec2> plane;
  std::vector<double> heights;
  for (const Vec3& p : given.points) plane.push_back(p.head<2>()), heights.push_back(p.z());
  const std::vector<std::uint8_t> is_fixed(4, 0);
  const bool is_flat = limit_slopes({plane, given.triangles, is_fixed}, 1, rounding, heights);
  Flattened made{given};
  double largest = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    made.needles.points[i].z() = heights[i];
    largest = std::max(largest, std::abs(heights[i] - given.points[i].z()));
  }
  if (is_flat) made.largest_move = largest;
  return made;
}

// To flatten these needles, a far corner must move several times by less than half the spacing of
// single-precision numbers. The moves must add up, although rounding would undo each of them alone.
TEST(SlopeLimit, NeedlesGetFarByMovesThatRoundingTakes) {
  const Needles needles = stored({{Vec3(20.0135155, 20.0189285, 3.00464439),
                                   {20.0135326, 20.0189762, 3.00460148},
                                   {20.0127182, 20.0178108, 3.00594687},
                                   {20.017622, 20.015379, 3.00349522}}});
  ASSERT_GT(steepest(needles), 1.01);
  const Flattened made = flattened(needles, Rounding::single_precision);
  EXPECT_LE(steepest(made.needles), 1);
  EXPECT_LT(made.largest_move, 3e-6);
  EXPECT_EQ(stored(made.needles).points, made.needles.points);
}

// A small move flattens one needle but makes the other one steep. Both become flat only if the far corners
// move hundreds of times as far as that.
TEST(SlopeLimit, NeedlesThatUndoEachOtherGetThere) {
  const Needles needles = stored({{Vec3(20.0088615, 20.0504284, 3.0039897),
                                   {20.0088387, 20.0504589, 3.0040071},
                                   {20.0094261, 20.0471478, 3.00126696},
                                   {20.008707, 20.0542355, 3.00342178}}});
  ASSERT_GT(steepest(needles), 1.03);
  for (const Rounding rounding : {Rounding::none, Rounding::single_precision}) {
    const Flattened made = flattened(needles, rounding);
    EXPECT_LE(steepest(made.needles), 1);
    EXPECT_LT(made.largest_move, 1e-4);
  }
}

// Returns two needles that share a short edge, with slopes up to `most` before rounding. The edge is 20 to 200 times as
// long as the spacing of single-precision numbers there. The needles are 10 to 100 times as long as the edge.
Needles random_needles(test::Random& random, double most) {
  const double edge = std::exp(random.uniform(std::log(4e-5), std::log(4e-4))),
               turn = random.uniform(0, 2 * std::numbers::pi);
  const auto along = [&](double angle) { return Vec2(std::cos(turn + angle), std::sin(turn + angle)); };
  const auto raised = [](const Vec2& p, const Vec2& slope) {
    return Vec3(20 + p.x(), 20 + p.y(), 3 + slope.dot(p));
  };
  const double shared = random.uniform(-.95, .95), most_across = std::sqrt(most * most - shared * shared);
  Needles needles;
  needles.points[0] = raised({0, 0}, {0, 0});
  needles.points[1] = raised(edge * along(0), shared * along(0));
  for (const int side : {1, -1}) {
    const Vec2 far =
        edge * std::exp(random.uniform(std::log(10), std::log(100))) * along(side * random.uniform(.3, 2.8));
    const Vec2 slope =
        shared * along(0) + random.uniform(-most_across, most_across) * along(std::numbers::pi / 2);
    needles.points[side == 1 ? 2 : 3] = raised(far, slope);
  }
  return stored(needles);
}

TEST(SlopeLimit, NeedlesOfAllKinds) {
  for (std::uint64_t seed = 0; seed < 5000; ++seed) {
    test::Random random(seed);
    const Needles needles = random_needles(random, 1.03);
    for (const Rounding rounding : {Rounding::none, Rounding::single_precision}) {
      const Flattened made = flattened(needles, rounding);
      ASSERT_LE(steepest(made.needles), 1) << seed;
      ASSERT_LT(made.largest_move, .03 * rise_of(needles)) << seed;
    }
  }
}

}  // namespace
}  // namespace relievo
