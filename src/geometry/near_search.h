// Finds the points near each of many positions with few queries of a k-d tree.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "core/simd.h"
#include "geometry/neighbours.h"

namespace relievo {

// Finds the points in balls. Consecutive balls should be close together, as along a space-filling curve; then
// one query of the tree serves several of them. The result for a ball does not depend on the other balls.
template <typename Point>
class NearSearch {
 public:
  struct Ball {
    Point centre;
    double radius;
  };

  // `tree` contains `points`; both must outlive the search.
  NearSearch(const KdTree<Point>& tree, std::span<const Point> points) : tree_(tree), points_(points) {}

  // Calls use(i, near) for each i in [begin, end). `near` has the indices of the points that are nearer to
  // the centre of ball(i) than its radius, in ascending order. It is valid only during the call.
  template <typename BallOf, typename Use>
  void each(std::size_t begin, std::size_t end, BallOf&& ball, Use&& use) {
    for (std::size_t first = begin; first < end; first += most_together)
      together(first, std::min(end, first + most_together), ball, use);
  }

 private:
  static constexpr std::size_t most_together = 16;
  // The largest radius of a common query for several balls, as a multiple of the smallest ball's radius.
  static constexpr double widest = 4;
  static constexpr int dimension = Point::RowsAtCompileTime;

  template <typename BallOf, typename Use>
  void together(std::size_t begin, std::size_t end, BallOf& ball, Use& use) {
    Ball first = ball(begin);
    Point low = first.centre, high = low;
    double least = first.radius, most = least;
    for (std::size_t i = begin + 1; i < end; ++i) {
      const Ball next = ball(i);
      low = low.cwiseMin(next.centre), high = high.cwiseMax(next.centre);
      least = std::min(least, next.radius), most = std::max(most, next.radius);
    }
    const double reach = (high - low).norm() / 2 + most;
    if (end - begin > 1 && reach > widest * least) {
      const std::size_t middle = (begin + end) / 2;
      together(begin, middle, ball, use);
      together(middle, end, ball, use);
      return;
    }
    constexpr double rounding = 1e-9;
    collect((low + high) / 2, (1 + rounding) * reach);
    for (std::size_t i = begin; i < end; ++i) use(i, within(ball(i)));
  }

  // Collects the points within a radius, in ascending order.
  void collect(const Point& centre, double radius) {
    tree_.within(centre, radius, matches_);
    numbers_.clear();
    for (const auto& [i, distance_sq] : matches_) numbers_.push_back(i);
    sort_numbers();
    for (int axis = 0; axis < dimension; ++axis) {
      coordinates_[axis].resize(numbers_.size());
      for (std::size_t k = 0; k < numbers_.size(); ++k) coordinates_[axis][k] = points_[numbers_[k]][axis];
    }
    distances_sq_.resize(numbers_.size());
    near_.resize(numbers_.size());
  }

  // Sorts the indices in `numbers_`, which all differ. If the points are in the order of a space-filling
  // curve, the indices are close to each other. Then marking them in a list of bits is faster than comparing
  // them.
  void sort_numbers() {
    constexpr std::size_t most_words = 4;  // words of bits per index; if there are more, comparing is faster
    if (numbers_.empty()) return;
    const auto [least, most] = std::ranges::minmax(numbers_);
    const std::size_t words = (most - least) / 64 + 1;
    if (words > most_words * numbers_.size()) {
      std::ranges::sort(numbers_);
      return;
    }
    marks_.assign(words, 0);
    for (const Index i : numbers_) marks_[(i - least) / 64] |= std::uint64_t{1} << (i - least) % 64;
    std::size_t count = 0;
    for (std::size_t word = 0; word < words; ++word)
      for (std::uint64_t rest = marks_[word]; rest != 0; rest &= rest - 1)
        numbers_[count++] = least + static_cast<Index>(64 * word + std::countr_zero(rest));
  }

  // Returns the indices of the collected points in a ball.
  std::span<const Index> within(const Ball& ball) {
    const std::size_t n = numbers_.size();
    RELIEVO_WIDE(find_distances(ball.centre, distances_sq_.data(), n));
    std::size_t count = 0;
    for (std::size_t k = 0; k < n; ++k) {
      near_[count] = numbers_[k];  // overwritten unless this point is in the ball, which avoids a branch
      count += distances_sq_[k] < ball.radius * ball.radius;
    }
    return std::span(near_).first(count);
  }

  RELIEVO_INLINE void find_distances(const Point& centre, double* distances_sq, std::size_t n) const {
    std::array<const double*, dimension> from;
    for (std::size_t axis = 0; axis < dimension; ++axis) from[axis] = coordinates_[axis].data();
    for (std::size_t k = 0; k < n; ++k) {
      double sum = 0;
      for (std::size_t axis = 0; axis < dimension; ++axis) {
        const double step = from[axis][k] - centre[axis];
        sum += step * step;
      }
      distances_sq[k] = sum;
    }
  }

  const KdTree<Point>& tree_;
  std::span<const Point> points_;
  std::vector<typename KdTree<Point>::Match> matches_;
  std::vector<Index> numbers_, near_;
  std::vector<std::uint64_t> marks_;
  std::array<std::vector<double>, dimension> coordinates_;
  std::vector<double> distances_sq_;
};

}  // namespace relievo
