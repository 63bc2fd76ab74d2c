#include "relievo/cholesky.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <limits>

#include "shapes.h"

namespace relievo {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

// A random sparse matrix made positive definite: B B^T + I.
Sparse random_spd(int n, std::uint64_t seed) {
  test::Random random(seed);
  Eigen::MatrixXd B = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i < 3 * n; ++i) B(random.bits() % n, random.bits() % n) = random.uniform(-1, 1);
  return Eigen::MatrixXd(B * B.transpose() + Eigen::MatrixXd::Identity(n, n)).sparseView();
}

TEST(Cholesky, AgreesWithDenseEigen) {
  for (const int n : {1, 2, 10, 80}) {
    const Sparse A = random_spd(n, static_cast<std::uint64_t>(n));
    const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(n, -1, 2);
    const Eigen::VectorXd truth = Eigen::MatrixXd(A).llt().solve(b);
    Eigen::VectorXd x(n);
    const auto factor = Cholesky::factor(A);
    ASSERT_TRUE(factor);
    factor->solve({b.data(), b.data() + n}, {x.data(), x.data() + n});
    EXPECT_LT((x - truth).norm(), 1e-10 * truth.norm());
  }
}

TEST(Cholesky, SolvesInPlace) {
  const Sparse A = random_spd(20, 3);
  Eigen::VectorXd x = Eigen::VectorXd::Ones(20);
  Cholesky::factor(A)->solve({x.data(), x.data() + 20}, {x.data(), x.data() + 20});
  EXPECT_LT((A * x - Eigen::VectorXd::Ones(20)).norm(), 1e-10);
}

TEST(Cholesky, OfNoUnknownsSolvesNothing) {
  const auto factor = Cholesky::factor(Sparse(0, 0));
  ASSERT_TRUE(factor);
  EXPECT_EQ(factor->size(), 0U);
  factor->solve({}, {});
}

TEST(Cholesky, RefusesWhatIsNotPositiveDefinite) {
  Sparse indefinite(2, 2), singular(2, 2), not_finite(1, 1);
  indefinite.insert(0, 0) = 1;
  indefinite.insert(1, 1) = -1;
  singular.insert(0, 0) = 1;
  not_finite.insert(0, 0) = std::numeric_limits<double>::quiet_NaN();
  for (const Sparse& A : {indefinite, singular, not_finite, Sparse(2, 3)}) {
    const auto factor = Cholesky::factor(A);
    ASSERT_FALSE(factor);
    EXPECT_EQ(factor.error().kind, ErrorKind::geometry);
  }
}

}  // namespace
}  // namespace relievo
