#include "solver/bounded_fit.h"

#include <Eigen/Dense>

#include "support/planar_systems.h"
#include "support/results.h"

namespace relievo::solver {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

Vector random_vector(int n, double low, double high, std::uint64_t seed) {
  test::Random random(seed);
  Vector v(n);
  for (double& value : v) value = random.uniform(low, high);
  return v;
}

Matrix dense(const Eigen::SparseMatrix<double>& lower) {
  return Matrix(lower).selfadjointView<Eigen::Lower>();
}

// Returns a problem on a jittered grid. The bounds lie between the extremes of the unbounded solution, so they matter.
BoundedFit problem(int width, int height, bool is_plate, std::uint64_t seed) {
  test::PlanarSystem system = test::jittered_grid(width, height, seed);
  const int n = width * height;
  BoundedFit fit{std::move(system.A)};
  fit.positions = std::move(system.positions);
  fit.load = random_vector(n, -1, 1, seed + 1);
  fit.lowest = random_vector(n, -.4, -.1, seed + 2), fit.highest = random_vector(n, .1, .4, seed + 3);
  if (is_plate) fit.mass = random_vector(n, .5, 2, seed + 4);
  return fit;
}

// The energy 1/2 x^T H x - f^T x of a problem, with dense matrices. For a plate, the constant term is left out.
struct DenseEnergy {
  Matrix H;
  Vector f;

  explicit DenseEnergy(const BoundedFit& fit) : H(dense(fit.A)), f(fit.load) {
    if (fit.mass.size() == 0) return;
    const Matrix A = H;
    H = A * fit.mass.cwiseInverse().asDiagonal() * A;
    f = A * fit.load.cwiseQuotient(fit.mass);
  }

  double operator()(const Vector& x) const { return x.dot(H * x) / 2 - f.dot(x); }
};

// Returns the solution for one choice of active bounds, if it satisfies the Karush-Kuhn-Tucker conditions. The base-3
// digits of `choice` say for each unknown whether it is free, at its lower bound or at its upper bound.
std::optional<Vector> solution_for(const BoundedFit& fit, const DenseEnergy& energy, int choice) {
  const auto n = static_cast<int>(fit.load.size());
  Matrix K = Matrix::Identity(n, n);
  Vector right(n), side = Vector::Zero(n);
  for (int i = 0; i < n; ++i, choice /= 3) {
    side[i] = choice % 3 - 1;
    right[i] = side[i] < 0 ? fit.lowest[i] : side[i] > 0 ? fit.highest[i] : energy.f[i];
    if (side[i] == 0) K.row(i) = energy.H.row(i);
  }
  const Vector x = K.partialPivLu().solve(right), g = energy.H * x - energy.f;
  for (int i = 0; i < n; ++i) {
    if (x[i] < fit.lowest[i] - 1e-9 || x[i] > fit.highest[i] + 1e-9) return {};
    if (side[i] != 0 && side[i] * g[i] > 1e-9) return {};
  }
  return x;
}

TEST(BoundedFit, IsTheSolutionAmongAllSetsOfActiveBounds) {
  for (const bool is_plate : {false, true})
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      const BoundedFit fit = problem(3, 3, is_plate, seed);
      const DenseEnergy energy(fit);
      std::optional<Vector> expected;
      for (int choice = 0; choice < 19683 && !expected; ++choice)  // 3^9
        expected = solution_for(fit, energy, choice);
      ASSERT_TRUE(expected);
      const BoundedFitResult found = value_of(minimise(fit, 1e-9));
      EXPECT_LE((found.x - *expected).cwiseAbs().maxCoeff(), 1e-4) << is_plate << ' ' << seed;
    }
}

// The test computes the duality gap itself. The energy of a more exact solution must not be lower by more
// than this gap.
TEST(BoundedFit, KeepsItsBoundsAndItsTolerance) {
  for (const bool is_plate : {false, true}) {
    const BoundedFit fit = problem(30, 20, is_plate, 5);
    const DenseEnergy energy(fit);
    const BoundedFitResult rough = value_of(minimise(fit, 1e-2)), fine = value_of(minimise(fit, 1e-8));
    for (const BoundedFitResult& found : {rough, fine}) {
      EXPECT_GT((found.x - fit.lowest).minCoeff(), 0);
      EXPECT_GT((fit.highest - found.x).minCoeff(), 0);
      const Vector g = energy.H * found.x - energy.f;
      const double gap =
          (found.x - fit.lowest).dot(g.cwiseMax(0)) + (fit.highest - found.x).dot((-g).cwiseMax(0));
      EXPECT_NEAR(found.gap, gap, 1e-9 * std::abs(found.energy));
    }
    const double at_zero = is_plate ? fit.load.dot(fit.load.cwiseQuotient(fit.mass)) / 2 : 0;
    const double scale = std::max(std::abs(rough.energy), at_zero);
    EXPECT_LE(rough.gap, 1e-2 * scale);
    EXPECT_GT(rough.gap, fine.gap);
    EXPECT_NEAR(rough.energy - fine.energy, energy(rough.x) - energy(fine.x), 1e-9 * scale);
    EXPECT_LE(rough.energy - fine.energy, rough.gap);
    EXPECT_GE(rough.energy, fine.energy);
  }
}

TEST(BoundedFit, WithDistantBoundsSolvesTheEquations) {
  for (const bool is_plate : {false, true}) {
    BoundedFit fit = problem(12, 9, is_plate, 3);
    fit.lowest *= 1000, fit.highest *= 1000;
    const Matrix A = dense(fit.A);
    const Vector expected = A.llt().solve(fit.load);
    const BoundedFitResult found = value_of(minimise(fit, 1e-12));
    EXPECT_LE((found.x - expected).cwiseAbs().maxCoeff(), 1e-4 * expected.cwiseAbs().maxCoeff());
  }
}

// Without a ceiling, a string of length 1 under a load of 8 would rise to 1. Under a ceiling at 1/4, it is a
// parabola up to a distance of sqrt(2 * 0.25 / 8) = 1/4 from its ends. In between it touches the ceiling.
TEST(BoundedFit, OfAStringUnderACeilingIsItsClosedForm) {
  constexpr int n = 199;
  constexpr double step = 1. / (n + 1);
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n; ++i) {
    entries.emplace_back(i, i, 2 / step);
    if (i > 0) entries.emplace_back(i, i - 1, -1 / step);
  }
  BoundedFit fit{Eigen::SparseMatrix<double>(n, n)};
  fit.A.setFromTriplets(entries.begin(), entries.end());
  fit.load = Vector::Constant(n, 8 * step);
  fit.lowest = Vector::Constant(n, -1), fit.highest = Vector::Constant(n, .25);
  const BoundedFitResult found = value_of(minimise(fit, 1e-10));
  for (int i = 0; i < n; ++i) {
    const double from_end = step * (std::min(i, n - 1 - i) + 1);
    const double expected = from_end < .25 ? 4 * from_end * (.5 - from_end) : .25;
    EXPECT_NEAR(found.x[i], expected, 1e-4) << i;
  }
}

}  // namespace
}  // namespace relievo::solver
