// Computes with functions in space and their first and second derivatives, for equation (3).
#pragma once

#include "relievo/core/types.h"

namespace relievo::paper {

// The value, gradient and Hessian of a function at one point.
struct Jet {
  double value = 0;
  Vec3 gradient = Vec3::Zero();
  Mat3 hessian = Mat3::Zero();

  Jet& operator+=(const Jet& other) {
    value += other.value;
    gradient += other.gradient;
    hessian += other.hessian;
    return *this;
  }

  friend Jet operator*(double factor, const Jet& a) {
    return {factor * a.value, factor * a.gradient, factor * a.hessian};
  }

  friend Jet operator*(const Jet& a, const Jet& b) {
    const Mat3 mixed = a.gradient * b.gradient.transpose();
    return {a.value * b.value, a.value * b.gradient + b.value * a.gradient,
            a.value * b.hessian + b.value * a.hessian + mixed + mixed.transpose()};
  }
};

// The value of a function of one variable, and its first and second derivative, at one place.
struct Derivatives {
  double value, first, second;
};

// Returns f(a), given f and its derivatives at the value of `a`.
inline Jet chain(const Derivatives& f, const Jet& a) {
  return {f.value, f.first * a.gradient,
          f.first * a.hessian + f.second * a.gradient * a.gradient.transpose()};
}

using JetVector = std::array<Jet, 3>;

// Returns the scalar product of `offset` and `n` as a function of a point. `offset` is the point's position
// relative to a fixed point, and `n` is a vector that depends on the point.
inline Jet dot(const Vec3& offset, const JetVector& n) {
  Jet sum;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const Jet& n_i = n[static_cast<std::size_t>(i)];
    sum += offset[i] * n_i;
    sum.gradient[i] += n_i.value;
    sum.hessian.row(i) += n_i.gradient.transpose();
    sum.hessian.col(i) += n_i.gradient;
  }
  return sum;
}

}  // namespace relievo::paper
