// Factor once, solve per frame: a sparse symmetric positive definite system.
#pragma once

#include <Eigen/SparseCore>
#include <memory>
#include <span>

#include "relievo/error.h"

namespace relievo {

// Owns the factorisation of one matrix. Concurrent solves are safe.
class Cholesky {
 public:
  // Factors A, of which the lower triangle is read. A 0 x 0 matrix is fine. Errors: kind geometry if A is not
  // square, has an entry that is not finite, or is not positive definite.
  static Result<Cholesky> factor(const Eigen::SparseMatrix<double>& A);

  Cholesky(Cholesky&&) noexcept;
  Cholesky& operator=(Cholesky&&) noexcept;
  ~Cholesky();

  // Number of unknowns.
  std::size_t size() const;

  // Writes to x the solution of A x = b. Both have size() elements; they may be the same storage.
  void solve(std::span<const double> b, std::span<double> x) const;

 private:
  struct Factor;
  explicit Cholesky(std::unique_ptr<Factor> factor);
  std::unique_ptr<Factor> factor_;
};

}  // namespace relievo
