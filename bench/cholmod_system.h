// CHOLMOD, to compare with: a system factored once and solved again and again.
#pragma once

#include <cholmod.h>

#include <Eigen/SparseCore>
#include <algorithm>
#include <span>

namespace relievo {

class CholmodSystem {
 public:
  // Analyses and factors the matrix, whose lower triangle is read, by that order of elimination alone.
  CholmodSystem(const Eigen::SparseMatrix<double>& matrix, int ordering) {
    cholmod_start(&common_);
    common_.nmethods = 1;
    common_.method[0].ordering = ordering;
    auto& source = const_cast<Eigen::SparseMatrix<double>&>(matrix);
    cholmod_sparse A{};
    A.nrow = A.ncol = static_cast<std::size_t>(source.cols());
    A.nzmax = static_cast<std::size_t>(source.nonZeros());
    A.p = source.outerIndexPtr();
    A.i = source.innerIndexPtr();
    A.x = source.valuePtr();
    A.stype = -1;
    A.itype = CHOLMOD_INT;
    A.xtype = CHOLMOD_REAL;
    A.dtype = CHOLMOD_DOUBLE;
    A.sorted = A.packed = 1;
    factor_ = cholmod_analyze(&A, &common_);
    cholmod_factorize(&A, factor_, &common_);
    b_ = cholmod_zeros(A.nrow, 1, CHOLMOD_REAL, &common_);
  }
  CholmodSystem(const CholmodSystem&) = delete;
  CholmodSystem& operator=(const CholmodSystem&) = delete;
  ~CholmodSystem() {
    for (cholmod_dense** dense : {&b_, &x_, &y_, &e_}) cholmod_free_dense(dense, &common_);
    cholmod_free_factor(&factor_, &common_);
    cholmod_finish(&common_);
  }

  // Returns the solution; it is overwritten by the next call.
  std::span<const double> solve(std::span<const double> b) {
    std::copy(b.begin(), b.end(), static_cast<double*>(b_->x));
    cholmod_solve2(CHOLMOD_A, factor_, b_, nullptr, &x_, nullptr, &y_, &e_, &common_);
    return {static_cast<const double*>(x_->x), b.size()};
  }

 private:
  cholmod_common common_;
  cholmod_factor* factor_ = nullptr;
  cholmod_dense *b_ = nullptr, *x_ = nullptr, *y_ = nullptr, *e_ = nullptr;
};

}  // namespace relievo
