#include "dense_front.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "shapes.h"

namespace relievo {
namespace {

Eigen::MatrixXd random_spd(Index n, std::uint64_t seed) {
  test::Random random(seed);
  Eigen::MatrixXd B(n, n);
  for (double& element : B.reshaped()) element = random.uniform(-1, 1);
  return B * B.transpose() + static_cast<double>(n) * Eigen::MatrixXd::Identity(n, n);
}

Front front_of(const Eigen::MatrixXd& A) {
  Front front;
  front.reset(static_cast<Index>(A.rows()));
  for (Index c = 0; c < front.rows; ++c)
    for (Index r = c; r < front.rows; ++r) front.column(c)[r] = A(r, c);
  return front;
}

Eigen::MatrixXd lower_of(Front& front) {
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(front.rows, front.rows);
  for (Index c = 0; c < front.rows; ++c)
    for (Index r = c; r < front.rows; ++r) A(r, c) = front.column(c)[r];
  return A;
}

// Sizes on both sides of every width that is treated on its own.
TEST(DenseFront, AgreesWithDenseEigen) {
  for (const Index n : {1U, 4U, 9U, 23U, 64U, 150U})
    for (const Index width : {1U, 2U, 5U, 8U, 9U, 17U, 40U, 150U}) {
      if (width > n) continue;
      const Eigen::MatrixXd A = random_spd(n, n * 1000 + width);
      Front front = front_of(A);
      const std::vector<double> smallest(width, 0);
      ASSERT_EQ(eliminate_columns(front, width, smallest), no_index);
      const Eigen::MatrixXd L = Eigen::MatrixXd(A.topLeftCorner(width, width).llt().matrixL());
      const Eigen::MatrixXd below = L.triangularView<Eigen::Lower>()
                                        .solve(A.bottomLeftCorner(n - width, width).transpose())
                                        .transpose();
      const Eigen::MatrixXd rest = A.bottomRightCorner(n - width, n - width) - below * below.transpose();
      const Eigen::MatrixXd eliminated = lower_of(front);
      EXPECT_LT((eliminated.topLeftCorner(width, width) - L).norm(), 1e-12 * L.norm());
      EXPECT_LE((eliminated.bottomLeftCorner(n - width, width) - below).norm(), 1e-12 * below.norm());
      const Eigen::MatrixXd rest_lower = rest.triangularView<Eigen::Lower>();
      EXPECT_LE((eliminated.bottomRightCorner(n - width, n - width) - rest_lower).norm(),
                1e-12 * rest.norm());

      invert_columns(front, width);
      const Eigen::MatrixXd W = lower_of(front), inverse = L.inverse();
      EXPECT_LT((W.topLeftCorner(width, width) - inverse).norm(), 1e-12 * inverse.norm());
      EXPECT_LE((W.bottomLeftCorner(n - width, width) + below * inverse).norm(), 1e-12 * below.norm());
    }
}

TEST(DenseFront, NamesTheColumnThatFails) {
  Eigen::MatrixXd A = random_spd(20, 5);
  A(13, 13) = -1;
  Front front = front_of(A);
  EXPECT_EQ(eliminate_columns(front, 20, std::vector<double>(20, 0)), 13U);
}

}  // namespace
}  // namespace relievo
