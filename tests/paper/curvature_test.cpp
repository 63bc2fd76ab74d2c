#include "paper/curvature.h"

#include <gtest/gtest.h>

#include <numeric>

#include "paper/jet.h"
#include "support/planar_points.h"
#include "support/shapes.h"

namespace relievo::paper {
namespace {

struct Statistics {
  double mean = 0, deviation = 0;
};

// Returns the mean and the standard deviation of the curvature of all points. rho is computed from the
// area of the shape.
Statistics curvature_of(const Cloud& cloud, double area) {
  const double n = static_cast<double>(cloud.size());
  std::vector<Index> all(cloud.size());
  std::iota(all.begin(), all.end(), Index{0});
  Statistics result;
  const std::vector<double> k = mean_curvature(cloud, std::sqrt(area / n), all);
  for (const double each : k) result.mean += each / n;
  for (const double each : k) result.deviation += (each - result.mean) * (each - result.mean) / n;
  result.deviation = std::sqrt(result.deviation);
  return result;
}

// The moving-least-squares surface of a sphere lies inside the sphere, so its curvature is slightly larger
// than that of the sphere. The points are random, so the curvature differs from point to point.
TEST(PaperCurvature, OfASphereIsThatOfItsRadius) {
  const double area = 16 * std::numbers::pi;
  const Statistics k = curvature_of(test::sphere(20000, 2), area);
  EXPECT_NEAR(k.mean, .5, .02);
  EXPECT_LT(k.deviation, .07);
  EXPECT_NEAR(curvature_of(test::inside_out(test::sphere(20000, 2)), area).mean, -.5, .02);
}

TEST(PaperCurvature, OfACylinderIsHalfThatOfASphere) {
  Cloud cloud = test::cylinder(20000, 1, 6);
  const double rho = std::sqrt(12 * std::numbers::pi / 20000);
  std::vector<Index> middle;
  for (Index i = 0; i < cloud.size(); ++i)
    if (std::abs(cloud.points[i].y()) < 2) middle.push_back(i);
  double mean = 0;
  for (const double k : mean_curvature(cloud, rho, middle)) mean += k / static_cast<double>(middle.size());
  EXPECT_NEAR(mean, .5, .02);
}

TEST(PaperCurvature, OfAPlaneIsZero) {
  const Statistics k = curvature_of(test::sheet(3000, 1, 0), 4);
  EXPECT_EQ(k.mean, 0);
  EXPECT_EQ(k.deviation, 0);
}

// On a tilted plane, normals in single precision cause curvatures of about 1e-8 / rho. These must be set to
// 0, because detail would amplify them.
TEST(PaperCurvature, OfALeaningPlaneIsZero) {
  const Vec3 normal = Vec3(.3, -.4, .7).normalized();
  Cloud cloud;
  for (const Vec2& p : random_points(3000))
    test::add(cloud, Vec3(p.x(), p.y(), -(normal.x() * p.x() + normal.y() * p.y()) / normal.z()), normal);
  const Statistics k = curvature_of(cloud, 1 / normal.z());
  EXPECT_EQ(k.mean, 0);
  EXPECT_EQ(k.deviation, 0);
}

// Computes the derivatives of exp(x y + z) at (1, 2, 0.5) by the rules of jets, and compares them with closed forms.
TEST(PaperJets, FollowTheRulesOfDerivatives) {
  const Vec3 p(1, 2, .5);
  const auto coordinate = [&](Eigen::Index i) { return Jet{p[i], Vec3::Unit(i), Mat3::Zero()}; };
  Jet exponent = coordinate(0) * coordinate(1);
  exponent += coordinate(2);
  const double value = std::exp(2.5);
  const Jet jet = chain({value, value, value}, exponent);
  const Vec3 gradient(2, 1, 1);
  Mat3 second = Mat3::Zero();
  second(0, 1) = second(1, 0) = 1;
  EXPECT_DOUBLE_EQ(jet.value, value);
  EXPECT_LT((jet.gradient - value * gradient).norm(), 1e-12);
  EXPECT_LT((jet.hessian - value * (gradient * gradient.transpose() + second)).norm(), 1e-12);
}

TEST(PaperJets, OfAScalarProductAreThoseOfItsTerms) {
  const Vec3 y(.3, -.7, 1.1);
  JetVector n;
  Jet expected;
  for (std::size_t i = 0; i < 3; ++i) {
    const double d = static_cast<double>(i) + 1;
    n[i] = {d, Vec3(d, -1, 2 * d), Mat3::Constant(.1 * d)};
    expected +=
        Jet{y[static_cast<Eigen::Index>(i)], Vec3::Unit(static_cast<Eigen::Index>(i)), Mat3::Zero()} * n[i];
  }
  const Jet product = dot(y, n);
  EXPECT_DOUBLE_EQ(product.value, expected.value);
  EXPECT_LT((product.gradient - expected.gradient).norm(), 1e-14);
  EXPECT_LT((product.hessian - expected.hessian).norm(), 1e-14);
}

}  // namespace
}  // namespace relievo::paper
