#include "plate/front/sample_front.h"

#include "support/planar_points.h"
#include "support/plate_fronts.h"
#include "support/triangles.h"

namespace relievo {
namespace {

constexpr double side = 20;

double dome(const Vec2& p) {
  return 2 - .02 * (p - Vec2(side / 2, side / 2)).squaredNorm();
}

// Returns a front over random points in a square and the corners of the square. Its heights are height(p).
template <typename F>
HeightFieldMesh front_of(F height, std::size_t n = 4000) {
  std::vector<Vec2> plane = random_points(n, 21);
  for (Vec2& p : plane) p *= side;
  for (int corner = 0; corner < 4; ++corner) plane.emplace_back(side * (corner % 2), side * (corner / 2));
  std::vector<Vec3> points;
  for (const Vec2& p : plane) points.emplace_back(p.x(), p.y(), height(p));
  return test::front_over(points);
}

bool is_far_from_hull(const Vec3& p) {
  return (p.head<2>() - Vec2(side / 2, side / 2)).cwiseAbs().maxCoeff() < .4 * side;
}

std::vector<std::uint8_t> all_of(const HeightFieldMesh& front, std::uint8_t flag) {
  return std::vector<std::uint8_t>(front.triangles.size(), flag);
}

// If the facet angle is 0.01, a cell of the sampling grid gets one sample; if it is 0.004, the cell gets four.
TEST(SampleFront, LiesOnASurfaceOfSecondDegree) {
  const HeightFieldMesh front = front_of(dome);
  const HeightFieldMesh single = sample_front(front, all_of(front, 1), {.2, .01}).value();
  const HeightFieldMesh fine = sample_front(front, all_of(front, 1), {.2, .004}).value();
  EXPECT_GT(fine.points.size(), 2 * single.points.size());
  for (const HeightFieldMesh& sampled : {single, fine}) {
    test::expect_counter_clockwise(sampled.points, sampled.triangles);
    EXPECT_NEAR(test::area_of(sampled.points, sampled.triangles), side * side, 1e-6);
    for (const Vec3& p : sampled.points)
      if (is_far_from_hull(p)) EXPECT_NEAR(p.z(), dome(p.head<2>()), 2e-3);
  }
}

TEST(SampleFront, IsFinerWhereAskedAndCoarserWherePlane) {
  const HeightFieldMesh curved = front_of([](const Vec2&p) { return std::sin(p.x()) * std::cos(p.y()); }),
                        plane = front_of([](const Vec2&p) { return .1 * p.x(); });
  const auto count = [](const HeightFieldMesh& front, double step) {
    return sample_front(front, all_of(front, 1), {step}).value().points.size();
  };
  EXPECT_GT(count(curved, .1), 2.5 * static_cast<double>(count(curved, .2)));
  EXPECT_LT(2 * count(plane, .1), count(curved, .1));
}

TEST(SampleFront, KeepsHullAndRange) {
  const HeightFieldMesh front =
      front_of([](const Vec2& p) { return std::sin(2 * p.x()) * std::cos(3 * p.y()); });
  const HeightFieldMesh sampled = sample_front(front, all_of(front, 1), {.15}).value();
  for (const Index i : front.hull)
    EXPECT_TRUE(
        std::ranges::any_of(sampled.hull, [&](Index j) { return sampled.points[j] == front.points[i]; }));
  for (const Index i : sampled.hull)
    EXPECT_DOUBLE_EQ((sampled.points[i].head<2>() - Vec2(side / 2, side / 2)).cwiseAbs().maxCoeff(),
                     side / 2);
  EXPECT_EQ(Box::of(sampled.points).max, Box::of(front.points).max);
  EXPECT_EQ(Box::of(sampled.points).min, Box::of(front.points).min);
}

TEST(SampleFront, HasNoThinTriangleAwayFromTheHull) {
  const HeightFieldMesh front = front_of(dome);
  const HeightFieldMesh sampled = sample_front(front, all_of(front, 1), {.2}).value();
  for (const Triangle& t : sampled.triangles) {
    double least = 4;
    bool is_far = true;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec2 p = sampled.points[t[i]].head<2>();
      is_far &= is_far_from_hull(sampled.points[t[i]]);
      const Vec2 u = sampled.points[t[(i + 1) % 3]].head<2>() - p,
                 v = sampled.points[t[(i + 2) % 3]].head<2>() - p;
      least = std::min(least, std::acos(u.normalized().dot(v.normalized())));
    }
    if (is_far) {
      EXPECT_GT(least, .2);  // 0.2 rad is 11 degrees
    }
  }
}

TEST(SampleFront, LeavesPlaneTrianglesAsTheyAre) {
  const HeightFieldMesh front = front_of(dome, 500);
  const HeightFieldMesh sampled = sample_front(front, all_of(front, 0), {.2}).value();
  EXPECT_EQ(sampled.points.size(), front.points.size());
  EXPECT_EQ(sampled.triangles.size(), front.triangles.size());
}

TEST(SampleFront, TellsReliefFromGround) {
  HeightFieldMesh front = front_of(dome);
  front.is_relief.resize(front.triangles.size());
  for (std::size_t t = 0; t < front.triangles.size(); ++t)
    front.is_relief[t] = front.points[front.triangles[t][0]].x() < side / 2;
  const HeightFieldMesh sampled = sample_front(front, all_of(front, 1), {.2}).value();
  ASSERT_EQ(sampled.is_relief.size(), sampled.triangles.size());
  for (std::size_t t = 0; t < sampled.triangles.size(); ++t) {
    const Vec3& p = sampled.points[sampled.triangles[t][0]];
    const double x = p.x(), to_hull = side / 2 - std::abs(p.y() - side / 2);
    if (std::abs(x - side / 2) > 1 && to_hull > 2) {  // triangles at the hull are long
      EXPECT_EQ(sampled.is_relief[t] != 0, x < side / 2);
    }
  }
}

TEST(SampleFront, EndsWhenCancelled) {
  const HeightFieldMesh front = front_of(dome, 500);
  Cancelled progress;
  EXPECT_EQ(sample_front(front, all_of(front, 1), {.2}, &progress).error().kind, ErrorKind::cancelled);
}

}  // namespace
}  // namespace relievo
