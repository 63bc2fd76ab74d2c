#include "paper/visible_points.h"

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace relievo::paper {
namespace {

// Applies the rule of section 3.2 of the paper by brute force. The points in the same cell as a point are
// found by testing all points.
TEST(PaperVisiblePoints, AreThoseNearTheHighestPointOfTheirCell) {
  const Cloud cloud = test::sphere(1500, 1);
  const double rho = .06;
  const Vec3 corner = Box::of(cloud.points).min;
  const auto column = [&](double x, double from) { return std::floor((x - from) / (2 * rho)); };
  std::vector<Index> expected;
  for (Index i = 0; i < cloud.size(); ++i) {
    const Vec3& p = cloud.points[i];
    double highest = p.z();
    for (const Vec3& q : cloud.points)
      if (column(q.x(), corner.x()) == column(p.x(), corner.x()) &&
          column(q.y(), corner.y()) == column(p.y(), corner.y()))
        highest = std::max(highest, q.z());
    if (highest - p.z() < 2 * rho && cloud.normals[i].z() > 0) expected.push_back(i);
  }
  EXPECT_EQ(visible_points(cloud, rho), expected);
  EXPECT_GT(expected.size(), 500U);
}

TEST(PaperVisiblePoints, FaceTheViewer) {
  EXPECT_EQ(visible_points(test::sheet(500, 1, 0), .1).size(), 500U);
  EXPECT_TRUE(visible_points(test::inside_out(test::sheet(500, 1, 0)), .1).empty());
}

}  // namespace
}  // namespace relievo::paper
