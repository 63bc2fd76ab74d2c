#include "scan/outlines/row_points.h"

#include <Eigen/LU>
#include <algorithm>
#include <functional>

#include "core/simd.h"
#include "relievo/core/parallel.h"

namespace relievo {
namespace {

using Value = SideInterpolation::Value;
using Numbers = Double4;  // depth in rho, n_x, n_y, curvature

constexpr double window = 3;                            // largest distance of samples, in rho
constexpr double trusted_depth = 1, trusted_lean = .2;  // misfits at which a sample's weight is halved
constexpr double stiffness = .001;                      // keeps fits to few points regular
constexpr double other_face = .35;  // least distance between the (n_x, n_y) of the two faces at a crease
constexpr int passes = 3;

class RowSmoother {
 public:
  RowSmoother(std::span<const RowPoint> points, std::span<const Value> values, double rho)
      : points_(points), rho_(rho) {
    before_.reserve(values.size());
    for (const Value& value : values) before_.push_back({numbers_of(value), value.is_known});
  }

  // Smooths the depth, the normal and the curvature of a point.
  void smooth(std::size_t point, Value& value) const {
    std::vector<Sample> samples = samples_near(point);
    for (int pass = 1; pass < passes; ++pass) {
      const Curve curve = fitted(samples);
      for (Sample& s : samples) {
        const Numbers off = s.numbers - (curve.begin + (curve.slope * s.share + curve.bend * s.share_sq));
        const double depth = off[0] / trusted_depth, lean = length_of_lean(off) / trusted_lean;
        s.trust = 1 / (1 + depth * depth + lean * lean);
      }
    }
    set(value, fitted(samples).begin);
  }

 private:
  struct Sample {
    double share;  // distance along the row from the smoothed point, as a share of the window
    Numbers numbers;
    double share_sq = share * share, trust = 1;
  };

  // The values of a point before smoothing.
  struct Before {
    Numbers numbers;
    bool is_known;
  };

  // A quadratic fitted to the samples: begin + slope * share + bend * share^2. `begin` is the value at the smoothed
  // point.
  struct Curve {
    Numbers begin, slope, bend;
  };

  static double length_of_lean(const Numbers& numbers) { return Vec2(numbers[1], numbers[2]).norm(); }

  // Returns the samples within the window in the row of the point, the point included. If a crease crosses the row,
  // only the samples on the point's side are returned, unless they are so few that the point is an outlier.
  std::vector<Sample> samples_near(std::size_t point) const {
    std::vector<Sample> samples;
    samples.reserve(24);
    samples.push_back({0, before_[point].numbers});
    for (const int side : {-1, 1}) {
      double along = 0;
      std::size_t k = point;
      while (true) {
        const std::size_t next = k + static_cast<std::size_t>(side);
        if (next >= points_.size() || points_[next].row != points_[point].row) break;
        along += (points_[next].at - points_[k].at).norm() / rho_;
        if (along >= window) break;
        if (before_[next].is_known) samples.push_back({side * along / window, before_[next].numbers});
        k = next;
      }
    }
    const Numbers own = samples.front().numbers;
    const auto is_alike = [&](const Sample& s) { return length_of_lean(s.numbers - own) < other_face; };
    const auto alike = static_cast<std::size_t>(std::ranges::count_if(samples, is_alike));
    if (alike >= std::max<std::size_t>(2, samples.size() / 3)) std::erase_if(samples, std::not_fn(is_alike));
    return samples;
  }

  Numbers numbers_of(const Value& v) const {
    return Numbers{v.point.z() / rho_, static_cast<double>(v.normal.x()), static_cast<double>(v.normal.y()),
                   v.k};
  }

  static Curve fitted(const std::vector<Sample>& samples) {
    Mat3 moments = Mat3::Zero();
    Numbers sum = {}, by_share = {}, by_square = {};
    for (const Sample& s : samples) {
      const double weight = s.trust * (1 - s.share_sq) * (1 - s.share_sq);
      const Vec3 powers(1, s.share, s.share_sq), weighted = weight * powers;
      moments += weighted * powers.transpose();
      sum += weight * s.numbers, by_share += weighted[1] * s.numbers, by_square += weighted[2] * s.numbers;
    }
    moments(1, 1) += stiffness * moments(0, 0);
    moments(2, 2) += stiffness * moments(0, 0);
    const Mat3 inverse = moments.inverse();
    const auto row = [&](Eigen::Index i) -> Numbers {
      return inverse(i, 0) * sum + (inverse(i, 1) * by_share + inverse(i, 2) * by_square);
    };
    return {row(0), row(1), row(2)};
  }

  void set(Value& value, const Numbers& numbers) const {
    value.point.z() = numbers[0] * rho_;
    value.normal = normal_with({numbers[1], numbers[2]}).cast<float>();
    value.k = numbers[3];
  }

  std::span<const RowPoint> points_;
  double rho_;
  std::vector<Before> before_;
};

}  // namespace

std::vector<Value> smoothed_along_rows(std::span<const RowPoint> points, std::vector<Value> values,
                                       double rho) {
  const RowSmoother smoother(points, values, rho);
  parallel_for(
      points.size(),
      [&](std::size_t i) {
        if (points[i].row != no_row && values[i].is_known) smoother.smooth(i, values[i]);
      },
      64);
  return values;
}

}  // namespace relievo
