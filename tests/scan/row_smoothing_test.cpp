#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "scan/outlines/row_points.h"

namespace relievo {
namespace {

using Values = std::vector<SideInterpolation::Value>;

constexpr double rho = .1, spacing = .5;  // spacing: distance between points of a row, in rho

// Returns a row of `count` points along the x axis.
std::vector<RowPoint> row(std::size_t count, Index number) {
  std::vector<RowPoint> points;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2 at(spacing * rho * static_cast<double>(i), 0);
    points.push_back({at, at, Place::front, number});
  }
  return points;
}

// Returns values whose depths increase by rho / 2 over a length of rho.
Values slope(const std::vector<RowPoint>& points) {
  Values values;
  for (const RowPoint& p : points) {
    SideInterpolation::Value value;
    value.is_known = true;
    value.point = {p.at.x(), p.at.y(), .5 * p.at.x()};
    value.normal = Vec3f(-.5F, 0, 1).normalized();
    value.k = 2;
    values.push_back(value);
  }
  return values;
}

TEST(RowSmoothing, KeepsAStraightRow) {
  const auto points = row(30, 1);
  const Values before = slope(points), after = smoothed_along_rows(points, before, rho);
  for (std::size_t i = 6; i + 6 < points.size(); ++i) {
    EXPECT_NEAR(after[i].point.z(), before[i].point.z(), 1e-9);
    EXPECT_LT((after[i].normal - before[i].normal).norm(), 1e-6F);
    EXPECT_NEAR(after[i].k, 2, 1e-9);
  }
}

TEST(RowSmoothing, AnOutlierGoesAndMovesItsNeighboursLittle) {
  const auto points = row(30, 1);
  const Values straight = slope(points);
  Values before = straight;
  before[15].point.z() += 10 * rho;
  const Values after = smoothed_along_rows(points, before, rho);
  for (std::size_t i = 6; i + 6 < points.size(); ++i)
    EXPECT_NEAR(after[i].point.z(), straight[i].point.z(), .5 * rho) << i;
}

TEST(RowSmoothing, ReducesScatter) {
  const auto points = row(200, 1);
  const Values straight = slope(points);
  Values before = straight;
  std::mt19937 random(1);
  for (auto& value : before) value.point.z() += rho * (static_cast<double>(random() % 1000) / 1000 - .5);
  const Values after = smoothed_along_rows(points, before, rho);
  double scatter_before = 0, scatter_after = 0;
  for (std::size_t i = 6; i + 6 < points.size(); ++i) {
    scatter_before += std::pow(before[i].point.z() - straight[i].point.z(), 2);
    scatter_after += std::pow(after[i].point.z() - straight[i].point.z(), 2);
  }
  EXPECT_LT(scatter_after, .25 * scatter_before);
}

TEST(RowSmoothing, KeepsACreaseAcrossTheRow) {
  const auto points = row(30, 1);
  Values before = slope(points);
  for (std::size_t i = 15; i < 30; ++i) {
    before[i].point.z() = before[15].point.z() - .5 * (points[i].at.x() - points[15].at.x());
    before[i].normal = Vec3f(.5F, 0, 1).normalized();
  }
  const Values after = smoothed_along_rows(points, before, rho);
  for (std::size_t i = 0; i < 30; ++i) EXPECT_LT((after[i].normal - before[i].normal).norm(), 1e-5F) << i;
}

TEST(RowSmoothing, RowsDoNotMix) {
  auto points = row(20, 1);
  for (RowPoint& p : row(20, 2)) points.push_back({p.at, p.at, Place::back, 2});
  Values before = slope(points);
  for (std::size_t i = 20; i < 40; ++i) before[i].point.z() -= 50 * rho;
  const Values after = smoothed_along_rows(points, before, rho);
  for (std::size_t i = 0; i < 20; ++i)
    EXPECT_NEAR(after[i].point.z() - after[i + 20].point.z(), 50 * rho, 1e-9) << i;
}

TEST(RowSmoothing, PointsOfNoRowAndUnknownOnesStay) {
  auto points = row(20, no_row);
  Values before = slope(points);
  before[7].point.z() += rho;
  EXPECT_EQ(smoothed_along_rows(points, before, rho)[7].point, before[7].point);
  points = row(20, 3);
  before[7].is_known = false;
  EXPECT_FALSE(smoothed_along_rows(points, before, rho)[7].is_known);
  EXPECT_EQ(smoothed_along_rows(points, before, rho)[7].point, before[7].point);
}

}  // namespace
}  // namespace relievo
