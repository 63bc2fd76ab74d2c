#include "relievo/solver/cholesky.h"

#include <rapidcheck.h>

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>
#include <atomic>
#include <cstdlib>
#include <limits>
#include <new>

#include "support/planar_systems.h"
#include "support/results.h"
#include "support/same_bits.h"

namespace {
std::atomic<std::size_t> allocations = 0;
}

// Counts all allocations of the test program. Sanitizers replace operator new themselves, so nothing is counted in
// their builds. The operators are not inlined, because the compiler would then warn that new and free do not match.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define RELIEVO_COUNTS_ALLOCATIONS
[[gnu::noinline]] void* operator new(std::size_t bytes) {
  ++allocations;
  if (void* p = std::malloc(bytes > 0 ? bytes : 1)) return p;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* p) noexcept {
  std::free(p);
}
[[gnu::noinline]] void operator delete(void* p, std::size_t) noexcept {
  std::free(p);
}
#endif

namespace relievo::solver {
namespace {

using test::jittered_grid;
using test::PlanarSystem;
using test::random_vector;
using test::Sparse;

// Returns a random sparse positive definite matrix B B^T + I.
Sparse random_spd(int n, std::uint64_t seed) {
  test::Random random(seed);
  Eigen::MatrixXd B = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i < 3 * n; ++i) B(random.bits() % n, random.bits() % n) = random.uniform(-1, 1);
  return Eigen::MatrixXd(B * B.transpose() + Eigen::MatrixXd::Identity(n, n)).sparseView();
}

template <typename Vector>
auto span_of(Vector& v) {
  return std::span(v.data(), static_cast<std::size_t>(v.size()));
}

Eigen::VectorXd solved(const Cholesky& factor, const Eigen::VectorXd& b) {
  Eigen::VectorXd x(b.size());
  factor.solve(span_of(b), span_of(x));
  return x;
}

Eigen::VectorXf solved_in_single(const Cholesky& factor, const Eigen::VectorXd& b) {
  const Eigen::VectorXf b_single = b.cast<float>();
  Eigen::VectorXf x(b.size());
  Cholesky::Workspace workspace = factor.make_workspace();
  factor.solve(span_of(b_single), span_of(x), workspace);
  return x;
}

double relative_error(const Eigen::VectorXd& x, const Eigen::VectorXd& truth) {
  return (x - truth).cwiseAbs().maxCoeff() / std::max(truth.cwiseAbs().maxCoeff(), 1e-300);
}

// Compares the solutions in single and in double precision with those of Eigen.
void expect_agreement(const Sparse& A, std::span<const Vec2> positions) {
  const Eigen::VectorXd b = random_vector(A.rows());
  const Eigen::SimplicialLDLT<Sparse> oracle(A);
  const Eigen::VectorXd truth = oracle.solve(b);
  const auto factor = value_of(Cholesky::factor(A, positions));
  EXPECT_LT(relative_error(solved(factor, b), truth), 1e-11);
  EXPECT_LT(relative_error(solved_in_single(factor, b).cast<double>(), truth), 1e-5);
}

TEST(Cholesky, AgreesWithDenseEigen) {
  for (const int n : {1, 2, 3, 7, 8, 9, 10, 31, 80, 250}) {
    const Sparse A = random_spd(n, static_cast<std::uint64_t>(n));
    const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(n, -1, 2);
    const Eigen::VectorXd truth = Eigen::MatrixXd(A).llt().solve(b);
    EXPECT_LT((solved(value_of(Cholesky::factor(A)), b) - truth).norm(), 1e-10 * truth.norm());
  }
}

TEST(Cholesky, AgreesWithSparseEigenOnPlanarGraphs) {
  for (const auto& [width, height] : {std::pair(3, 3), {1, 500}, {20, 40}, {130, 130}, {1000, 9}}) {
    const PlanarSystem system = jittered_grid(width, height);
    expect_agreement(system.A, system.positions);
  }
}

// Positions determine only the order of elimination. So the solutions must be correct for any positions.
TEST(Cholesky, IsRightWhereverThePositionsAre) {
  const PlanarSystem system = jittered_grid(45, 40);
  std::vector<Vec2> nowhere(system.positions.size(), Vec2(3, 4)), line = nowhere, infinite = nowhere;
  for (std::size_t i = 0; i < line.size(); ++i) line[i].x() = static_cast<double>(i % 7);
  infinite[5].x() = std::numeric_limits<double>::infinity();
  infinite[6].y() = std::numeric_limits<double>::quiet_NaN();
  for (const auto& positions :
       {std::vector<Vec2>(), nowhere, line, infinite, test::shuffled(system.positions)})
    expect_agreement(system.A, positions);
}

TEST(Cholesky, SolvesGraphsOfManyPieces) {
  const PlanarSystem piece = jittered_grid(12, 11);
  const int pieces = 40, n = static_cast<int>(piece.A.rows());
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<Vec2> positions;
  for (int p = 0; p < pieces; ++p) {
    for (int j = 0; j < n; ++j)
      for (Sparse::InnerIterator e(piece.A, j); e; ++e)
        entries.emplace_back(static_cast<int>(e.row()) + p * n, j + p * n, e.value());
    for (const Vec2& at : piece.positions) positions.push_back(at + Vec2(p % 7, p % 5));  // pieces overlap
  }
  Sparse A(pieces * n, pieces * n);
  A.setFromTriplets(entries.begin(), entries.end());
  expect_agreement(A, positions);
}

TEST(Cholesky, OfADiagonalMatrixDivides) {
  const int n = 5000;
  Sparse A(n, n);
  for (int i = 0; i < n; ++i) A.insert(i, i) = i + 1;
  const Eigen::VectorXd b = random_vector(n), x = solved(*Cholesky::factor(A), b);
  for (int i = 0; i < n; ++i) ASSERT_NEAR(x[i] * (i + 1), b[i], 1e-13);
}

// One vertex is connected to all others, so the matrix has a dense column.
TEST(Cholesky, SolvesAStar) {
  const int n = 3000;
  Sparse A(n, n);
  A.insert(0, 0) = n;
  for (int i = 1; i < n; ++i) {
    A.insert(i, 0) = -1;
    A.insert(i, i) = 1.5;
  }
  expect_agreement(A, {});
}

TEST(Cholesky, ReadsTheLowerTriangleAlone) {
  Sparse A = random_spd(30, 4), B = A;
  for (int j = 0; j < 30; ++j)
    for (Sparse::InnerIterator e(B, j); e; ++e)
      if (e.row() < j) e.valueRef() = 100;
  const Eigen::VectorXd b = random_vector(30);
  EXPECT_EQ(solved(*Cholesky::factor(A), b), solved(*Cholesky::factor(B), b));
}

TEST(Cholesky, HoldsForAnyGrid) {
  const bool holds = rc::check([] {
    const int width = *rc::gen::inRange(1, 40), height = *rc::gen::inRange(1, 40);
    const PlanarSystem system = jittered_grid(width, height, *rc::gen::arbitrary<std::uint64_t>());
    const Eigen::VectorXd truth = random_vector(system.A.rows(), *rc::gen::arbitrary<std::uint64_t>());
    const Eigen::VectorXd b = system.A.selfadjointView<Eigen::Lower>() * truth;
    const auto factor = Cholesky::factor(system.A, system.positions);
    RC_ASSERT(factor.has_value());
    RC_ASSERT(relative_error(solved(*factor, b), truth) < 1e-11);
    RC_ASSERT(relative_error(solved_in_single(*factor, b).cast<double>(), truth) < 1e-5);
  });
  ASSERT_TRUE(holds);
}

TEST(Cholesky, DoesNotMindTheUnit) {
  const PlanarSystem system = jittered_grid(30, 30);
  const auto factor = Cholesky::factor(system.A, system.positions);
  const Eigen::VectorXd b = random_vector(900), x = solved(*factor, b);
  for (const double unit : {0x1p-400, 0x1p300})
    EXPECT_EQ(solved(*factor, unit * b), unit * x);  // exact, because the factor is a power of two
  EXPECT_EQ(solved(*factor, Eigen::VectorXd::Zero(900)), Eigen::VectorXd::Zero(900));
}

TEST(Cholesky, RefinementInDoubleLowersTheResidual) {
  const PlanarSystem system = jittered_grid(100, 100);
  const auto factor = Cholesky::factor(system.A, system.positions);
  const Eigen::VectorXd b = random_vector(10000);
  const auto residual = [&](const Eigen::VectorXd& x) {
    return (system.A.selfadjointView<Eigen::Lower>() * x - b).cwiseAbs().maxCoeff();
  };
  EXPECT_GT(residual(solved_in_single(*factor, b).cast<double>()), 1e-9);
  EXPECT_LT(residual(solved(*factor, b)), 1e-13);
}

TEST(Cholesky, SolvesInPlace) {
  const PlanarSystem system = jittered_grid(60, 50);
  const auto factor = Cholesky::factor(system.A, system.positions);
  Cholesky::Workspace workspace = factor->make_workspace();
  const Eigen::VectorXd b = random_vector(3000);
  Eigen::VectorXd x = b;
  factor->solve(span_of(x), span_of(x), workspace);
  EXPECT_EQ(x, solved(*factor, b));
  Eigen::VectorXf x_single = b.cast<float>();
  factor->solve(span_of(x_single), span_of(x_single), workspace);
  EXPECT_EQ(x_single, solved_in_single(*factor, b));
}

TEST(Cholesky, AllocatesNothingPerSolve) {
#ifndef RELIEVO_COUNTS_ALLOCATIONS
  GTEST_SKIP() << "sanitizers count on their own";
#endif
  const PlanarSystem system = jittered_grid(150, 150);
  const auto factor = Cholesky::factor(system.A, system.positions);
  Cholesky::Workspace workspace = factor->make_workspace();
  Eigen::VectorXd x = random_vector(22500);
  Eigen::VectorXf x_single = x.cast<float>();
  factor->solve(span_of(x), span_of(x), workspace);
  const std::size_t before = allocations;
  ASSERT_GT(before, 0U);
  factor->solve(span_of(x_single), span_of(x_single), workspace);
  factor->solve(span_of(x), span_of(x), workspace);
  EXPECT_EQ(allocations, before);
}

std::pair<Eigen::VectorXd, Eigen::VectorXf> both(const PlanarSystem& system) {
  const auto factor = Cholesky::factor(system.A, system.positions);
  const Eigen::VectorXd b = random_vector(system.A.rows());
  return {solved(*factor, b), solved_in_single(*factor, b)};
}

TEST(Cholesky, HasTheSameBitsForAnyNumberOfThreadsAndInstructions) {
  const PlanarSystem large = jittered_grid(170, 160), small = jittered_grid(90, 80);
  test::expect_same_for_any_threads([&] { return both(large); });
  test::expect_same_without_avx2([&] { return both(small); });
}

TEST(Cholesky, FindsItsUnknownsByTheirNumbers) {
  const PlanarSystem system = jittered_grid(30, 20);
  auto factor = Cholesky::factor(system.A, system.positions);
  const std::size_t n = factor->size();
  std::vector<double> b(n), x(n), wide(2 * n, -1);
  for (std::size_t i = 0; i < n; ++i) b[i] = std::sin(static_cast<double>(i));
  factor->solve(b, x);
  std::vector<Index> numbers(n);
  for (std::size_t i = 0; i < n; ++i) numbers[i] = static_cast<Index>(2 * n - 1 - 2 * i);
  for (std::size_t i = 0; i < n; ++i) wide[numbers[i]] = b[i];
  factor->renumber(numbers);
  factor->solve(wide, wide);
  for (std::size_t i = 0; i < n; ++i) ASSERT_EQ(wide[numbers[i]], x[i]);
  for (std::size_t i = 0; i < 2 * n; i += 2) ASSERT_EQ(wide[i], -1);
}

TEST(Cholesky, TakesLittleMemory) {
  const PlanarSystem system = jittered_grid(200, 200);
  EXPECT_LT(Cholesky::factor(system.A, system.positions)->memory(), 260U * 40000);
}

TEST(Cholesky, OfNoUnknownsSolvesNothing) {
  const auto factor = value_of(Cholesky::factor(Sparse(0, 0)));
  EXPECT_EQ(factor.size(), 0U);
  factor.solve(std::span<const double>(), std::span<double>());
}

TEST(Cholesky, RefusesWhatIsNotPositiveDefinite) {
  Sparse indefinite(2, 2), singular(2, 2), not_finite(1, 1), floating = jittered_grid(20, 20).A;
  indefinite.insert(0, 0) = 1;
  indefinite.insert(1, 1) = -1;
  singular.insert(0, 0) = 1;
  not_finite.insert(0, 0) = std::numeric_limits<double>::quiet_NaN();
  // Each row adds up to 0, so the matrix is singular. Its last pivot is 0 only up to rounding.
  for (int j = 0; j < 400; ++j) floating.coeffRef(j, j) = 0;
  for (int j = 0; j < 400; ++j)
    for (Sparse::InnerIterator e(floating, j); e; ++e)
      if (e.row() > j) {
        floating.coeffRef(j, j) -= e.value();
        floating.coeffRef(e.row(), e.row()) -= e.value();
      }
  for (const Sparse& A : {indefinite, singular, not_finite, floating, Sparse(2, 3)})
    expect_error(Cholesky::factor(A), ErrorKind::geometry);
  EXPECT_EQ(
      Cholesky::factor(indefinite).error().message(),
      "matrix, unknown 1: expected a symmetric positive definite matrix, found a pivot that is not positive");
}

TEST(Cholesky, RefusesPositionsOfAnotherSystem) {
  expect_error(Cholesky::factor(random_spd(5, 1), std::vector<Vec2>(4, Vec2(0, 0))), ErrorKind::option);
}

}  // namespace
}  // namespace relievo::solver
