#include "relievo/relief/heights.h"

#include "relief/sliced_ell_matrix.h"
#include "support/differences.h"
#include "support/least_squares.h"
#include "support/results.h"
#include "support/shapes.h"

namespace relievo {
namespace {

// Random points in a disc of radius 1. The first `rim` points lie on its circle and form the boundary.
struct DiscCase {
  std::vector<Vec2> points;
  Triangulation mesh;
  Boundary boundary;

  explicit DiscCase(std::size_t inside, std::size_t rim = 300) {
    for (std::size_t i = 0; i < rim; ++i) {
      const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(rim);
      points.emplace_back(std::cos(angle), std::sin(angle));
    }
    test::Random random(31);
    while (points.size() < inside + rim) {
      const Vec2 p(random.uniform(-1, 1), random.uniform(-1, 1));
      if (p.norm() < .99) points.push_back(p);
    }
    mesh = delaunay(points);
    boundary.is_inside.assign(mesh.triangles.size(), 1);
    boundary.is_boundary.assign(points.size(), 0);
    std::fill_n(boundary.is_boundary.begin(), rim, std::uint8_t{1});
  }

  HeightSystem system(const std::vector<float>& weights = {}) const {
    return HeightSystem::build(points, mesh, boundary, weights).value();
  }
  // Returns random weights between 0.1 and 1, one per point.
  std::vector<float> uneven() const {
    test::Random random(7);
    std::vector<float> weights;
    while (weights.size() < points.size()) weights.push_back(static_cast<float>(random.uniform(.1, 1)));
    return weights;
  }
};

template <typename F>
std::vector<Vec2> slopes_of(const std::vector<Vec2>& points, F slope) {
  std::vector<Vec2> slopes(points.size());
  std::transform(points.begin(), points.end(), slopes.begin(), slope);
  return slopes;
}

std::vector<double> heights_of(const HeightSystem& system, const std::vector<Vec2>& slopes) {
  std::vector<double> z(system.size());
  system.solve(slopes, z);
  return z;
}

// Along an edge, the rise of a quadratic function is exactly the mean of the slopes at both ends. So the
// heights must be those of the paraboloid up to rounding, for any weights of the edges.
TEST(Heights, OfAParaboloidAreExact) {
  const DiscCase disc(5000);
  const auto slopes = slopes_of(disc.points, [](const Vec2& p) { return Vec2(-2 * p); });
  for (const std::vector<float>& weights : {std::vector<float>(), disc.uneven()}) {
    const std::vector<double> z = heights_of(disc.system(weights), slopes);
    for (std::size_t i = 0; i < z.size(); ++i) ASSERT_NEAR(z[i], 1 - disc.points[i].squaredNorm(), 1e-6);
  }
}

TEST(Heights, InSinglePrecisionAgreeWithDouble) {
  const DiscCase disc(20000);
  const HeightSystem system = disc.system();
  const auto slopes = slopes_of(disc.points, [](const Vec2& p) { return Vec2(std::sin(9 * p.x()), p.y()); });
  std::vector<Vec2f> single(slopes.size());
  std::transform(slopes.begin(), slopes.end(), single.begin(),
                 [](const Vec2& s) { return Vec2f(s.cast<float>()); });
  std::vector<float> z(system.size());
  HeightSystem::Workspace workspace = system.make_workspace();
  system.solve(single, z, workspace);
  const std::vector<double> truth = heights_of(system, slopes);
  const auto [lowest, highest] = std::ranges::minmax(truth);
  EXPECT_LE(test::largest_difference(z, truth), 1e-5 * (highest - lowest));
}

// Expects that the heights equal those of an independent solution of equation (9). Returns the heights.
std::vector<double> expect_least_squares(const DiscCase& disc, const std::vector<float>& weights) {
  const auto slopes = slopes_of(disc.points, [](const Vec2& p) { return Vec2(p.y() + .3, p.x() * p.x()); });
  std::vector<double> z = heights_of(disc.system(weights), slopes);
  const test::EquationNine nine{disc.points, disc.mesh, disc.boundary, weights};
  EXPECT_LE(test::largest_difference(z, test::least_squares_heights(nine, slopes)), 1e-6);
  return z;
}

TEST(Heights, MinimiseEquationNine) {
  DiscCase disc(400, 40);
  expect_least_squares(disc, {});
  const std::vector<double> uneven = expect_least_squares(disc, disc.uneven());
  for (const Vec2& p : disc.points)
    disc.boundary.wall_side.push_back(std::abs(p.x()) > .2 ? WallSide::none
                                      : p.x() > 0          ? WallSide::front
                                                           : WallSide::back);
  EXPECT_EQ(expect_least_squares(disc, disc.uneven()), uneven) << "walls have no weights of their own";
}

// Two separate discs. The triangles between them are marked as outside.
struct TwoDiscs {
  std::vector<Vec2> points;
  Triangulation mesh;
  Boundary boundary;

  explicit TwoDiscs(bool is_second_held) {
    const DiscCase large(2000), small(20, 30);
    points = large.points;
    for (const Vec2& p : small.points) points.push_back(.1 * p + Vec2(3, 0));
    mesh = delaunay(points);
    boundary.is_boundary = large.boundary.is_boundary;
    boundary.is_boundary.resize(points.size(), 0);
    if (is_second_held)
      std::fill_n(boundary.is_boundary.begin() + static_cast<std::ptrdiff_t>(large.points.size()), 30, 1);
    for (const Triangle& t : mesh.triangles) {
      const auto is_first = [&](Index i) { return points[i].x() < 2; };
      boundary.is_inside.push_back(is_first(t[0]) == is_first(t[1]) && is_first(t[1]) == is_first(t[2]));
    }
  }
};

TEST(Heights, OfAFragmentApartAreExactToo) {
  const TwoDiscs discs(true);
  const HeightSystem system = HeightSystem::build(discs.points, discs.mesh, discs.boundary).value();
  const Vec2 centre(3, 0);
  const auto slopes = slopes_of(discs.points, [&](const Vec2& p) -> Vec2 {
    return p.x() > 2 ? Vec2(-2 * (p - centre)) : Vec2(-2 * p);
  });
  const std::vector<double> z = heights_of(system, slopes);
  for (std::size_t i = 0; i < z.size(); ++i) {
    const bool is_second = discs.points[i].x() > 2;
    const double expected =
        is_second ? .01 - (discs.points[i] - centre).squaredNorm() : 1 - discs.points[i].squaredNorm();
    ASSERT_NEAR(z[i], expected, 1e-8);
  }
}

TEST(Heights, OfAFragmentThatNothingHoldsAreAnError) {
  const TwoDiscs discs(false);
  expect_error(HeightSystem::build(discs.points, discs.mesh, discs.boundary), ErrorKind::geometry);
}

TEST(Heights, OfBoundaryAloneAreZero) {
  DiscCase disc(0, 50);
  const HeightSystem system = disc.system();
  EXPECT_EQ(heights_of(system, std::vector<Vec2>(50, Vec2(1, 2))), std::vector<double>(50, 0.0));
}

// The memory of a matrix does not include a pattern that the matrix shares with another one. So smaller memory proves
// that the pattern is shared. Boundary points have no unknown. The test puts them first, and then last.
TEST(HeightSystem, HasThePatternThatVertexNormalsNeed) {
  for (const bool is_boundary_last : {false, true}) {
    DiscCase disc(500);
    if (is_boundary_last) {
      std::ranges::reverse(disc.points);
      std::ranges::reverse(disc.boundary.is_boundary);
      disc.mesh = delaunay(disc.points);
    }
    const HeightSystem system = disc.system();
    const auto memory = [&](const SlicedEllMatrix* like) {
      return vertex_normal_matrix(disc.points, disc.mesh, disc.boundary, like).memory();
    };
    EXPECT_LT(memory(&system.divergence_matrix()), memory(nullptr)) << is_boundary_last;
  }
}

}  // namespace
}  // namespace relievo
