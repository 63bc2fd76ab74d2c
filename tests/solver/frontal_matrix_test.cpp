#include "solver/frontal_matrix.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "support/shapes.h"

namespace relievo::solver {
namespace {

Eigen::MatrixXd random_spd(Index n, std::uint64_t seed) {
  test::Random random(seed);
  Eigen::MatrixXd B(n, n);
  for (double& element : B.reshaped()) element = random.uniform(-1, 1);
  return B * B.transpose() + static_cast<double>(n) * Eigen::MatrixXd::Identity(n, n);
}

FrontalMatrix front_of(const Eigen::MatrixXd& A) {
  FrontalMatrix front;
  front.reset(static_cast<Index>(A.rows()));
  for (Index c = 0; c < front.rows; ++c)
    for (Index r = c; r < front.rows; ++r) front.column(c)[r] = A(r, c);
  return front;
}

Eigen::MatrixXd lower_of(FrontalMatrix& front) {
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(front.rows, front.rows);
  for (Index c = 0; c < front.rows; ++c)
    for (Index r = c; r < front.rows; ++r) A(r, c) = front.column(c)[r];
  return A;
}

// The same from dense Eigen: L, what stands below it, and the Schur complement, in one lower triangle.
struct Truth {
  Eigen::MatrixXd eliminated, inverted;

  Truth(const Eigen::MatrixXd& A, Index width) : eliminated(A), inverted(A) {
    const Eigen::Index rest = A.rows() - width;
    const Eigen::MatrixXd L = A.topLeftCorner(width, width).llt().matrixL(), inverse = L.inverse();
    eliminated.topLeftCorner(width, width) = L;
    inverted.topLeftCorner(width, width) = inverse;
    if (rest > 0) {
      const Eigen::MatrixXd below = A.bottomLeftCorner(rest, width) * inverse.transpose();
      eliminated.bottomLeftCorner(rest, width) = below;
      eliminated.bottomRightCorner(rest, rest) -= below * below.transpose();
      inverted.rightCols(rest) = eliminated.rightCols(rest);
      inverted.bottomLeftCorner(rest, width) = -below * inverse;
    }
    eliminated.triangularView<Eigen::StrictlyUpper>().setZero();
    inverted.triangularView<Eigen::StrictlyUpper>().setZero();
  }
};

// Sizes on both sides of every width that is treated on its own.
TEST(FrontalMatrix, AgreesWithDenseEigen) {
  for (const Index n : {1U, 4U, 9U, 23U, 64U, 150U})
    for (const Index width : {1U, 2U, 5U, 8U, 9U, 17U, 40U, 150U}) {
      if (width > n) continue;
      const Eigen::MatrixXd A = random_spd(n, n * 1000 + width);
      const Truth truth(A, width);
      FrontalMatrix front = front_of(A);
      ASSERT_EQ(eliminate_columns(front, width, std::vector<double>(width, 0)), no_index);
      EXPECT_LT((lower_of(front) - truth.eliminated).norm(), 1e-12 * truth.eliminated.norm());
      invert_columns(front, width);
      EXPECT_LT((lower_of(front) - truth.inverted).norm(), 1e-12 * truth.inverted.norm());
    }
}

TEST(FrontalMatrix, NamesTheColumnThatFails) {
  Eigen::MatrixXd A = random_spd(20, 5);
  A(13, 13) = -1;
  FrontalMatrix front = front_of(A);
  EXPECT_EQ(eliminate_columns(front, 20, std::vector<double>(20, 0)), 13U);
}

}  // namespace
}  // namespace relievo::solver
