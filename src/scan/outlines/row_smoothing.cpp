#include "scan/outlines/row_smoothing.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <functional>

#include "relievo/core/parallel.h"

namespace relievo {
namespace {

using Value = SideInterpolation::Value;
using Numbers = Eigen::Vector4d;  // depth in rho, n_x, n_y, curvature
// Numbers at the smoothed point, then the coefficients of the linear and the quadratic term.
using Curve = Eigen::Matrix<double, 3, 4>;

constexpr double window = 3;                            // in rho
constexpr double trusted_depth = 1, trusted_lean = .2;  // misfits at which a point has half of its weight
constexpr double stiffness = .001;                      // keeps fits to few points regular
constexpr double other_face = .35;  // least difference of (n_x, n_y) between the two faces at a crease
constexpr int passes = 3;

class RowSmoother {
 public:
  RowSmoother(std::span<const RowPoint> points, std::span<const Value> values, double rho)
      : points_(points), values_(values), rho_(rho) {}

  Value at(std::size_t point) const {
    const std::vector<Sample> samples = samples_near(point);
    std::vector<double> trust(samples.size(), 1);
    Curve curve;
    for (int pass = 0; pass < passes; ++pass) {
      curve = fitted(samples, trust);
      for (std::size_t s = 0; s < samples.size(); ++s) {
        const Numbers off = samples[s].numbers - curve.transpose() * powers(samples[s].along);
        const double depth = off[0] / trusted_depth, lean = off.segment<2>(1).norm() / trusted_lean;
        trust[s] = 1 / (1 + depth * depth + lean * lean);
      }
    }
    return with_numbers(values_[point], curve.row(0).transpose());
  }

 private:
  struct Sample {
    double along;  // position along the row relative to the smoothed point, in rho
    Numbers numbers;
  };

  // Returns the samples of the point's row within the window, including the point. If a crease crosses the
  // row, only samples on the point's side are returned, unless these are so few that the point is an outlier.
  std::vector<Sample> samples_near(std::size_t point) const {
    std::vector<Sample> samples = {{0, numbers(point)}};
    for (const int side : {-1, 1}) {
      double along = 0;
      std::size_t k = point;
      while (true) {
        const std::size_t next = k + static_cast<std::size_t>(side);
        if (next >= points_.size() || points_[next].row != points_[point].row) break;
        along += (points_[next].at - points_[k].at).norm() / rho_;
        if (along >= window) break;
        if (values_[next].is_known) samples.push_back({side * along, numbers(next)});
        k = next;
      }
    }
    const auto is_alike = [own = Numbers(samples.front().numbers)](const Sample& s) {
      return (s.numbers - own).segment<2>(1).norm() < other_face;
    };
    const auto alike = static_cast<std::size_t>(std::ranges::count_if(samples, is_alike));
    if (alike >= std::max<std::size_t>(2, samples.size() / 3)) std::erase_if(samples, std::not_fn(is_alike));
    return samples;
  }

  Numbers numbers(std::size_t point) const {
    const Value& v = values_[point];
    return {v.point.z() / rho_, static_cast<double>(v.normal.x()), static_cast<double>(v.normal.y()), v.k};
  }

  static Vec3 powers(double along) {
    const double share = along / window;
    return {1, share, share * share};
  }

  static Curve fitted(const std::vector<Sample>& samples, const std::vector<double>& trust) {
    Mat3 moments = Mat3::Zero();
    Curve products = Curve::Zero();
    for (std::size_t s = 0; s < samples.size(); ++s) {
      const Vec3 p = powers(samples[s].along);
      const double weight = trust[s] * (1 - p[2]) * (1 - p[2]);
      moments += weight * p * p.transpose();
      products += weight * p * samples[s].numbers.transpose();
    }
    moments(1, 1) += stiffness * moments(0, 0);
    moments(2, 2) += stiffness * moments(0, 0);
    return moments.inverse() * products;
  }

  Value with_numbers(Value value, const Numbers& numbers) const {
    value.point.z() = numbers[0] * rho_;
    Vec2 lean = numbers.segment<2>(1);
    const double most = std::sqrt(1 - least_nz * least_nz);
    if (lean.norm() > most) lean *= most / lean.norm();
    value.normal = Vec3(lean.x(), lean.y(), std::sqrt(1 - lean.squaredNorm())).cast<float>();
    value.k = numbers[3];
    return value;
  }

  std::span<const RowPoint> points_;
  std::span<const Value> values_;
  double rho_;
};

}  // namespace

std::vector<Value> smoothed_along_rows(std::span<const RowPoint> points, std::vector<Value> values,
                                       double rho) {
  const RowSmoother smoother(points, values, rho);
  std::vector<Value> smoothed = values;
  parallel_for(
      points.size(),
      [&](std::size_t i) {
        if (points[i].row != no_row && values[i].is_known) smoothed[i] = smoother.at(i);
      },
      64);
  return smoothed;
}

}  // namespace relievo
