// Fits linear functions to scattered points in the plane by weighted least squares.
#pragma once

#include <Eigen/LU>
#include <cmath>

#include "relievo/core/types.h"

namespace relievo {

// Fits `Values` linear functions to samples around a position. The weight of a point falls from 1 at the
// position to 0 at the radius.
template <int Values>
class LinearField {
 public:
  using Value = Eigen::Matrix<double, Values, 1>;

  struct Fit {
    Value value = Value::Zero();  // the fitted value at the position
    Eigen::Matrix<double, 2, Values> gradient = Eigen::Matrix<double, 2, Values>::Zero();
    bool is_sloped = false;  // false if the points are nearly collinear; the value is then their mean
    double misfit = 0;       // root mean square of the residuals of a sloped fit
    double count = 0;        // sum of the points' weights
  };

  LinearField(const Vec2& place, double radius) : place_(place), radius_(radius) {}

  void add(const Vec2& at, const Value& value) {
    const Vec2 step = (at - place_) / radius_;
    const double rest = std::max(0.0, 1 - step.squaredNorm());
    const Vec3 powers(1, step.x(), step.y());
    moments_ += rest * rest * powers * powers.transpose();
    products_ += rest * rest * powers * value.transpose();
    squares_ += rest * rest * value.squaredNorm();
  }

  Fit fitted() const {
    Fit fit;
    if (!(moments_(0, 0) > 0)) return fit;
    const Vec2 centre = moments_.template block<2, 1>(1, 0) / moments_(0, 0);
    const Eigen::Matrix2d spread =
        moments_.template block<2, 2>(1, 1) / moments_(0, 0) - centre * centre.transpose();
    const Value mean = products_.row(0).transpose() / moments_(0, 0);
    fit.value = mean;
    const double least =
        .5 * (spread.trace() -
              std::sqrt(std::max(0.0, spread.trace() * spread.trace() - 4 * spread.determinant())));
    if (least < .01 || centre.norm() > 3 * std::sqrt(least)) return fit;
    const Eigen::Matrix<double, 3, Values> field = moments_.inverse() * products_;
    fit.value = field.row(0).transpose();
    fit.gradient = field.template bottomRows<2>() / radius_;
    fit.is_sloped = true;
    fit.count = moments_(0, 0);
    fit.misfit = std::sqrt(std::max(0.0, (squares_ - field.cwiseProduct(products_).sum()) / fit.count));
    return fit;
  }

 private:
  Vec2 place_;
  double radius_;
  double squares_ = 0;
  Mat3 moments_ = Mat3::Zero();
  Eigen::Matrix<double, 3, Values> products_ = Eigen::Matrix<double, 3, Values>::Zero();
};

}  // namespace relievo
