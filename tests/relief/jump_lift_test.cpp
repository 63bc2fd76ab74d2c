#include "relief/jump_lift.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "relief/style.h"
#include "relievo/relief/heights.h"
#include "relievo/scan/surface.h"
#include "scan/jumps.h"
#include "support/shapes.h"

namespace relievo {
namespace {

struct Prepared {
  explicit Prepared(const Cloud& cloud) : surface(find_surface(cloud, {}).value()) {}

  // Returns the heights that (9) gives for the shape.
  std::vector<double> heights(const Shape& shape) const {
    const std::vector<float> boundary_weight =
        boundary_weights(surface.boundary.distance, boundary_rho(surface, shape.boundary_width));
    std::vector<Vec2> slopes(surface.points.size());
    find_slopes(slope_input(surface, layers, boundary_weight), shape, slopes);
    std::vector<double> z(slopes.size());
    system.solve(slopes, z);
    return z;
  }

  Surface surface;
  std::vector<PointLayers> layers = normal_layers(surface.points, surface.normals);
  std::vector<float> weights = jump_weights(surface);
  HeightSystem system =
      HeightSystem::build(in_plane(surface.points), surface.triangulation, surface.boundary, weights).value();
  JumpLift lift = JumpLift::find({surface, layers, system});
};

Shape shape_at(double u, double gamma = layered_shape().gamma) {
  Shape shape = layered_shape();
  shape.compression.u = u;
  shape.gamma = gamma;
  shape.membrane = MembraneParams{.4};
  return shape;
}

// Returns for each edge across the wall how far its front end is above its back end.
std::vector<double> wall_steps(const Surface& surface, std::span<const double> z) {
  std::vector<double> steps;
  for (const Triangle& t : surface.triangulation.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const Index a = t[i], b = t[(i + 1) % 3];
      if (!surface.boundary.is_across_wall(a, b)) continue;
      steps.push_back(surface.boundary.wall_side[a] == WallSide::front ? z[a] - z[b] : z[b] - z[a]);
    }
  return steps;
}

// Returns how far the front side of the wall is below its back side, on average over the wall's edges. An
// edge whose front side is higher counts as 0.
double mean_inversion(const Surface& surface, std::span<const double> z) {
  const std::vector<double> steps = wall_steps(surface, z);
  double sum = 0;
  for (const double step : steps) sum += std::max(-step, 0.0);
  return sum / static_cast<double>(steps.size());
}

// Returns the fraction of the inversion that remains after the lift for that shape.
double inversion_left(const Prepared& prepared, const Shape& shape) {
  std::vector<double> z = prepared.heights(shape);
  const double before = mean_inversion(prepared.surface, z);
  EXPECT_GT(before, .04 * (*std::ranges::max_element(z) - *std::ranges::min_element(z)));
  prepared.lift.add_to(std::span(z), shape);
  return mean_inversion(prepared.surface, z) / before;
}

TEST(JumpLift, LevelsInvertedJumpsAtEveryHeight) {
  const Prepared flap_before_sheet(test::flap_before_a_sheet());
  for (const double u : {.1, .25, .5, 2.0, 9.0, 16.0})
    EXPECT_LT(inversion_left(flap_before_sheet, shape_at(u)), .12) << u;
}

// Inverted edges become nearly level, and upright ones hardly steeper.
TEST(JumpLift, BoundsTheStepsThatItMakes) {
  const Prepared flap_before_sheet(test::flap_before_a_sheet());
  for (const double u : {.25, 2.0, 16.0}) {
    std::vector<double> z = flap_before_sheet.heights(shape_at(u));
    const double height = *std::ranges::max_element(z) - *std::ranges::min_element(z);
    const std::vector<double> before = wall_steps(flap_before_sheet.surface, z);
    flap_before_sheet.lift.add_to(std::span(z), shape_at(u));
    const std::vector<double> after = wall_steps(flap_before_sheet.surface, z);
    for (std::size_t e = 0; e < before.size(); ++e) {
      ASSERT_GT(after[e], -.02 * height) << u;
      ASSERT_LT(after[e], std::max(before[e], 0.0) + .04 * height) << u;
    }
  }
}

// The lift is computed for the default gamma. For other values of gamma it must still lessen inversions.
TEST(JumpLift, LessensInversionsAtOtherDetails) {
  const Prepared flap_before_sheet(test::flap_before_a_sheet());
  for (const double gamma : {0.0, .02, .06})
    EXPECT_LT(inversion_left(flap_before_sheet, shape_at(1, gamma)), .7) << gamma;
}

double distance_to_wall(const Surface& surface, std::size_t i) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j < surface.points.size(); ++j)
    if (surface.boundary.wall_side[j] != WallSide::none)
      least = std::min(least, (surface.points[i] - surface.points[j]).head<2>().norm());
  return least;
}

TEST(JumpLift, MovesNothingFarFromJumpsNorOnTheSilhouette) {
  const Prepared flap_before_sheet(test::flap_before_a_sheet());
  const Surface& surface = flap_before_sheet.surface;
  std::vector<double> z(surface.points.size(), 0);
  flap_before_sheet.lift.add_to(std::span(z), shape_at(1));
  const double farthest = .05 * 3;  // .05 of the longer side, which is 3
  std::size_t moved = 0;
  for (std::size_t i = 0; i < z.size(); ++i) {
    if (z[i] == 0) continue;
    ++moved;
    EXPECT_FALSE(surface.boundary.is_boundary[i]);
    EXPECT_LT(distance_to_wall(surface, i), farthest);
  }
  EXPECT_GT(moved, 1000U);
}

// Returns the difference between a field's value at point i and a quadratic fit of the values around it.
double roughness(const Surface& surface, std::span<const double> y, std::size_t i) {
  std::vector<std::size_t> around;
  for (std::size_t j = 0; j < y.size(); ++j)
    if ((surface.points[j] - surface.points[i]).norm() < 3 * surface.rho) around.push_back(j);
  Eigen::MatrixXd terms(around.size(), 6);
  Eigen::VectorXd values(around.size());
  for (Eigen::Index k = 0; k < terms.rows(); ++k) {
    const std::size_t j = around[static_cast<std::size_t>(k)];
    const Vec2 p = (surface.points[j] - surface.points[i]).head<2>() / surface.rho;
    terms.row(k) << 1, p.x(), p.y(), p.x() * p.x(), p.x() * p.y(), p.y() * p.y();
    values[k] = y[j];
  }
  return y[i] - terms.colPivHouseholderQr().solve(values)[0];
}

TEST(JumpLift, IsSmoothOnUnevenTriangles) {
  const Prepared flap_before_sheet(test::flap_before_a_sheet(32000));
  const Surface& surface = flap_before_sheet.surface;
  std::vector<double> y(surface.points.size(), 0);
  flap_before_sheet.lift.add_to(std::span(y), shape_at(1));
  double sum_sq = 0, largest = 0, count = 0;
  for (std::size_t i = 0; i < y.size(); i += 7) {
    if (y[i] == 0) continue;
    const double from_wall = distance_to_wall(surface, i) / surface.rho;
    if (from_wall < 4 || from_wall > 6) continue;
    sum_sq += std::pow(roughness(surface, y, i), 2);
    largest = std::max(largest, std::abs(y[i]));
    ++count;
  }
  EXPECT_GT(count, 200);
  EXPECT_LT(std::sqrt(sum_sq / count), .006 * largest);
}

TEST(JumpLift, ChangesNothingWithoutJumpsAndWhereHeightsAreNotCorrected) {
  const Prepared ball(test::sphere(20000, 1));
  const Prepared flap_before_sheet(test::flap_before_a_sheet());
  const auto is_unchanged = [](const Prepared& prepared, const Shape& shape) {
    std::vector<double> z(prepared.surface.points.size(), 0);
    prepared.lift.add_to(std::span(z), shape);
    return std::ranges::all_of(z, [](double height) { return height == 0; });
  };
  EXPECT_TRUE(is_unchanged(ball, shape_at(1)));
  EXPECT_TRUE(is_unchanged(flap_before_sheet, shape_at(0)));
  EXPECT_TRUE(is_unchanged(flap_before_sheet, Shape{{1, 0}}));
  Shape uncorrected = shape_at(1);
  uncorrected.membrane->pull_length = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(is_unchanged(flap_before_sheet, uncorrected));
}

}  // namespace
}  // namespace relievo
