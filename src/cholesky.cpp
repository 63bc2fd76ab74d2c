#include "relievo/cholesky.h"

#include <Eigen/SparseCholesky>
#include <cmath>

namespace relievo {

struct Cholesky::Factor {
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> ldlt;
};

namespace {

Error not_positive_definite(std::string why) {
  return {ErrorKind::geometry, "matrix", {}, "expected a symmetric positive definite matrix, " + why};
}

bool is_finite(const Eigen::SparseMatrix<double>& A) {
  return Eigen::Map<const Eigen::ArrayXd>(A.valuePtr(), A.nonZeros()).isFinite().all();
}

}  // namespace

Cholesky::Cholesky(std::unique_ptr<Factor> factor) : factor_(std::move(factor)) {}
Cholesky::Cholesky(Cholesky&&) noexcept = default;
Cholesky& Cholesky::operator=(Cholesky&&) noexcept = default;
Cholesky::~Cholesky() = default;

Result<Cholesky> Cholesky::factor(const Eigen::SparseMatrix<double>& A) {
  if (A.rows() != A.cols()) return std::unexpected(not_positive_definite("found one that is not square"));
  Eigen::SparseMatrix<double> compressed = A;
  compressed.makeCompressed();
  if (!is_finite(compressed))
    return std::unexpected(not_positive_definite("found an entry that is not finite"));
  auto factor = std::make_unique<Factor>();
  if (A.rows() > 0) {
    factor->ldlt.compute(compressed);
    // LDL^T exists for indefinite matrices, too: the signs of D tell.
    if (factor->ldlt.info() != Eigen::Success || !(factor->ldlt.vectorD().minCoeff() > 0))
      return std::unexpected(not_positive_definite("found a pivot that is not positive"));
  }
  return Cholesky(std::move(factor));
}

std::size_t Cholesky::size() const {
  return static_cast<std::size_t>(factor_->ldlt.cols());
}

void Cholesky::solve(std::span<const double> b, std::span<double> x) const {
  if (size() == 0) return;
  const auto n = static_cast<Eigen::Index>(size());
  const Eigen::VectorXd solution = factor_->ldlt.solve(Eigen::Map<const Eigen::VectorXd>(b.data(), n));
  Eigen::Map<Eigen::VectorXd>(x.data(), n) = solution;
}

}  // namespace relievo
