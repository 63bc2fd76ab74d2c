#include "solver/bounded_fit.h"

#include <algorithm>
#include <cmath>

#include "relievo/solver/cholesky.h"

namespace relievo::solver {
namespace {

using Vector = Eigen::VectorXd;

bool is_plate(const BoundedFit& fit) {
  return fit.mass.size() > 0;
}

Vector laplacian(const BoundedFit& fit, const Vector& x) {
  return fit.A.selfadjointView<Eigen::Lower>() * x;
}

// Returns H x if `misfit` is A x, where H is the Hessian of the energy. Returns the gradient of the energy if
// `misfit` is A x - load.
Vector hessian(const BoundedFit& fit, const Vector& misfit) {
  return is_plate(fit) ? laplacian(fit, misfit.cwiseQuotient(fit.mass)) : misfit;
}

// The matrix H + D of a Newton step; D is diagonal. Systems with this matrix are solved by preconditioned
// conjugate gradients. A membrane has H = A, and the preconditioner is A + D. A plate has H = A M^-1 A, and
// the preconditioner is (A + E) M^-1 (A + E) with E = sqrt(M D). This product is H + D plus mixed terms
// (Pearson and Wathen, 2012). The number of iterations hardly grows with the number of unknowns. The only
// matrix that is factored, A + D or A + E, is as sparse as A.
class NewtonMatrix {
 public:
  static Result<NewtonMatrix> factor(const BoundedFit& fit, Vector D) {
    Eigen::SparseMatrix<double> shifted = fit.A;
    const Vector E = is_plate(fit) ? Vector(fit.mass.cwiseProduct(D).cwiseSqrt()) : D;
    // A alone is nearly singular, and D is small far from the bounds. So each diagonal entry of A grows by at
    // least this share of itself. The effect of a force then decays over about 300 edges.
    constexpr double least_shift = 1e-5;
    for (int i = 0; i < shifted.cols(); ++i) {
      double& diagonal = shifted.coeffRef(i, i);
      diagonal += std::max(E[i], least_shift * diagonal);
    }
    RELIEVO_TRY(Cholesky factor, Cholesky::factor(shifted, fit.positions));
    return NewtonMatrix(fit, std::move(D), std::move(factor));
  }

  // Solves until the residual is a hundredth of the first residual; the next Newton step corrects the rest.
  Vector solve(const Vector& b) {
    constexpr int most_iterations = 200;
    constexpr double reduction = 1e-2;
    Vector x = Vector::Zero(b.size()), r = b, z = preconditioned(r), p = z;
    double rz = r.dot(z);
    const double enough = reduction * reduction * rz;
    for (int i = 0; i < most_iterations && rz > enough; ++i) {
      const Vector Ap = hessian(fit_, laplacian(fit_, p)) + D_.cwiseProduct(p);
      const double alpha = rz / p.dot(Ap);
      x += alpha * p, r -= alpha * Ap;
      z = preconditioned(r);
      const double before = rz;
      rz = r.dot(z);
      p = z + rz / before * p;
    }
    return x;
  }

 private:
  NewtonMatrix(const BoundedFit& fit, Vector D, Cholesky factor)
      : fit_(fit), D_(std::move(D)), factor_(std::move(factor)), workspace_(factor_.make_workspace()) {}

  Vector preconditioned(const Vector& b) {
    Eigen::VectorXf x = b.cast<float>();
    substitute(x);
    if (!is_plate(fit_)) return x.cast<double>();
    x = x.cwiseProduct(fit_.mass.cast<float>()).eval();
    substitute(x);
    return x.cast<double>();
  }
  void substitute(Eigen::VectorXf& x) {
    const auto n = static_cast<std::size_t>(x.size());
    factor_.solve(std::span<const float>(x.data(), n), std::span<float>(x.data(), n), workspace_);
  }

  const BoundedFit& fit_;
  Vector D_;
  Cholesky factor_;
  Cholesky::Workspace workspace_;
};

// Returns the largest step in [0, 1] after which each value is at least a hundredth of the old one.
double step_that_keeps(const Vector& values, const Vector& change) {
  double step = 1;
  for (Eigen::Index i = 0; i < values.size(); ++i)
    if (change[i] < 0) step = std::min(step, -.99 * values[i] / change[i]);
  return step;
}

// The iterate of the method: the field, and the multipliers of its lower and its upper bounds.
class InteriorPoint {
 public:
  explicit InteriorPoint(const BoundedFit& fit) : fit_(fit), x_((fit.lowest + fit.highest) / 2) {
    evaluate();
    const double product = std::max(g_.cwiseAbs().dot(below_) / static_cast<double>(x_.size()), 1e-300);
    lower_ = product * below_.cwiseInverse();
    upper_ = product * above_.cwiseInverse();
  }

  double energy() const { return energy_; }
  double gap() const { return below_.dot(g_.cwiseMax(0)) + above_.dot((-g_).cwiseMax(0)); }
  const Vector& x() const { return x_; }

  Result<void> step() {
    const double product =
        centring_ * (below_.dot(lower_) + above_.dot(upper_)) / (2 * static_cast<double>(x_.size()));
    const Vector by_lower = lower_.cwiseQuotient(below_), by_upper = upper_.cwiseQuotient(above_);
    RELIEVO_TRY(NewtonMatrix matrix, NewtonMatrix::factor(fit_, by_lower + by_upper));
    const Vector change = matrix.solve(product * (below_.cwiseInverse() - above_.cwiseInverse()) - g_);
    const Vector lower = product * below_.cwiseInverse() - lower_ - by_lower.cwiseProduct(change),
                 upper = product * above_.cwiseInverse() - upper_ + by_upper.cwiseProduct(change);
    const double primal = std::min(step_that_keeps(below_, change), step_that_keeps(above_, -change)),
                 dual = std::min(step_that_keeps(lower_, lower), step_that_keeps(upper_, upper));
    x_ += primal * change, lower_ += dual * lower, upper_ += dual * upper;
    const double shorter = std::min(primal, dual);
    centring_ = shorter > .9 ? .05 : shorter > .5 ? .2 : .5;
    evaluate();
    return {};
  }

 private:
  void evaluate() {
    below_ = x_ - fit_.lowest, above_ = fit_.highest - x_;
    const Vector Ax = laplacian(fit_, x_), misfit = Ax - fit_.load;
    g_ = hessian(fit_, misfit);
    energy_ = is_plate(fit_) ? misfit.dot(misfit.cwiseQuotient(fit_.mass)) / 2 : x_.dot(Ax / 2 - fit_.load);
  }

  const BoundedFit& fit_;
  Vector x_, below_, above_, g_, lower_, upper_;
  double energy_ = 0;
  // Each bound has a product: the distance of x from the bound, times the bound's multiplier. The next step
  // aims at products that all equal `centring_` times the present mean product.
  double centring_ = .2;
};

}  // namespace

Result<BoundedFitResult> minimise(const BoundedFit& fit, double tolerance) {
  constexpr int most_steps = 100;
  const double at_zero = is_plate(fit) ? fit.load.dot(fit.load.cwiseQuotient(fit.mass)) / 2 : 0;
  InteriorPoint point(fit);
  int steps = 0;
  for (; steps < most_steps && point.gap() > tolerance * std::max(std::abs(point.energy()), at_zero); ++steps)
    RELIEVO_CHECK(point.step());
  return BoundedFitResult{point.x(), point.energy(), point.gap(), steps};
}

}  // namespace relievo::solver
