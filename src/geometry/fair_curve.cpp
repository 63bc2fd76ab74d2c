#include "geometry/fair_curve.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/plane.h"

namespace relievo {
namespace {

// A node at a length along the curve.
struct Sample {
  double length;
  Vec2 place;
  double weight;
};

// Samples in the order of their length; those of a closed curve repeat after `period`, which is 0 for open ones.
class Course {
 public:
  Course(std::vector<Sample> samples, double begin, double end, bool is_closed)
      : begin_(begin), end_(end), is_closed_(is_closed) {
    std::ranges::sort(samples, {}, &Sample::length);
    samples_ = std::move(samples);
  }

  double begin() const { return begin_; }
  double end() const { return end_; }
  double length() const { return end_ - begin_; }
  bool is_closed() const { return is_closed_; }
  std::vector<Sample>& samples() { return samples_; }

  // Calls use(sample, distance along the curve from `at`) for the samples between two lengths.
  template <typename Use>
  void between(double at, double from, double to, Use&& use) const {
    const double period = is_closed_ ? length() : 0;
    const int first = is_closed_ ? -1 : 0, last = is_closed_ ? 1 : 0;
    for (int turn = first; turn <= last; ++turn) {
      const double shift = turn * period;
      auto s = std::ranges::lower_bound(samples_, from - shift, {}, &Sample::length);
      for (; s != samples_.end() && s->length + shift <= to; ++s) use(*s, s->length + shift - at);
    }
  }

 private:
  std::vector<Sample> samples_;
  double begin_, end_;
  bool is_closed_;
};

// The part of a course that a fit may use: up to its corners, or all of it.
struct Piece {
  double from, to;
};

double kernel(double share) {
  const double rest = std::max(0.0, 1 - share * share);
  return rest * rest;
}

// Returns the value at `at` of the quadratic that fits the samples around best.
Vec2 fitted(const Course& course, double at, const Piece& piece, double window) {
  constexpr std::size_t enough = 5;
  Mat3 moments;
  Eigen::Matrix<double, 3, 2> products;
  for (int attempt = 0; attempt < 6; ++attempt, window *= 1.5) {
    moments = Mat3::Zero();
    products.setZero();
    std::size_t count = 0;
    const auto add = [&](const Sample& s, double distance) {
      const double u = distance / window, weight = s.weight * kernel(u);
      const Vec3 powers(1, u, u * u);
      moments += weight * powers * powers.transpose();
      products += weight * powers * s.place.transpose();
      count += weight > 0;
    };
    course.between(at, std::max(piece.from, at - window), std::min(piece.to, at + window), add);
    if (count >= enough) break;
  }
  if (!(moments(0, 0) > 0)) return Vec2::Zero();
  // A little of the identity keeps the fit defined where samples are few.
  moments(1, 1) += 1e-6 * moments(0, 0);
  moments(2, 2) += 1e-3 * moments(0, 0);
  return moments.ldlt().solve(products).row(0).transpose();
}

// Returns the course of nodes by the length of their polyline, whose zigzag is smoothed away first.
Course course_of(std::span<const CurveNode> nodes, bool is_closed) {
  const std::size_t n = nodes.size();
  std::vector<Vec2> smooth;
  for (const CurveNode& node : nodes) smooth.push_back(node.place);
  for (int pass = 0; pass < 3; ++pass) {
    const std::vector<Vec2> before = smooth;
    for (std::size_t i = 0; i < n; ++i)
      if (is_closed || (i > 0 && i + 1 < n))
        smooth[i] = (before[(i + n - 1) % n] + 2 * before[i] + before[(i + 1) % n]) / 4;
  }
  std::vector<Sample> samples;
  double length = 0;
  for (std::size_t i = 0; i < n; ++i) {
    samples.push_back({length, nodes[i].place, nodes[i].weight});
    if (i + 1 < n || is_closed) length += (smooth[(i + 1) % n] - smooth[i]).norm();
  }
  return Course(std::move(samples), 0, length, is_closed);
}

// Returns points of the course, evenly spaced in its length, both ends included if it is open.
std::vector<Vec2> drawn(const Course& course, const FairCurveOptions& options) {
  const auto steps = std::max<std::size_t>(8, std::lround(course.length() / (.5 * options.spacing)));
  const Piece whole = course.is_closed() ? Piece{-1e300, 1e300} : Piece{course.begin(), course.end()};
  std::vector<Vec2> line(steps + (course.is_closed() ? 0 : 1));
  for (std::size_t k = 0; k < line.size(); ++k)
    line[k] =
        fitted(course, course.begin() + course.length() * static_cast<double>(k) / static_cast<double>(steps),
               whole, options.window);
  return line;
}

// Returns the course of the same samples by length along a line that was drawn from it. A sample whose place is
// far from the line counts little.
Course along(const std::vector<Vec2>& line, const Course& course, const FairCurveOptions& options) {
  const std::size_t n = line.size(), edges = course.is_closed() ? n : n - 1;
  std::vector<double> length(edges + 1, 0);
  for (std::size_t k = 0; k < edges; ++k) length[k + 1] = length[k] + (line[(k + 1) % n] - line[k]).norm();
  const double per_length = static_cast<double>(edges) / course.length();
  const auto reach = static_cast<std::ptrdiff_t>(std::ceil(options.window * per_length)) + 1;
  std::vector<Sample> samples;
  Course copy = course;
  for (const Sample& s : copy.samples()) {
    const auto middle = static_cast<std::ptrdiff_t>((s.length - course.begin()) * per_length);
    double best = 1e300, at = 0;
    for (std::ptrdiff_t e = middle - reach; e <= middle + reach; ++e) {
      if (!course.is_closed() && (e < 0 || e >= static_cast<std::ptrdiff_t>(edges))) continue;
      const auto size = static_cast<std::ptrdiff_t>(edges);
      const auto k = static_cast<std::size_t>(((e % size) + size) % size);
      const Vec2 step = line[(k + 1) % n] - line[k];
      const double share =
          std::clamp((s.place - line[k]).dot(step) / std::max(step.squaredNorm(), 1e-300), 0.0, 1.0);
      const double distance = (s.place - line[k] - share * step).norm();
      if (distance < best) best = distance, at = length[k] + share * step.norm();
    }
    const double ratio = best / (.6 * options.spacing);
    samples.push_back({at, s.place, s.weight / (1 + ratio * ratio)});
  }
  return Course(std::move(samples), 0, length.back(), course.is_closed());
}

// A straight line through samples.
struct Side {
  Vec2 point, direction;
  double misfit = 1e300;  // root mean square
};

Side side_of(const Course& course, double at, double from, double to) {
  Vec2 mean = Vec2::Zero(), mean_step = Vec2::Zero();
  double weights = 0, mean_length = 0;
  std::size_t count = 0;
  course.between(at, from, to, [&](const Sample& s, double distance) {
    mean += s.weight * s.place, mean_length += s.weight * distance, weights += s.weight, ++count;
  });
  if (count < 3 || !(weights > 0)) return {};
  mean /= weights, mean_length /= weights;
  course.between(at, from, to, [&](const Sample& s, double distance) {
    mean_step += s.weight * (distance - mean_length) * (s.place - mean);
  });
  if (!(mean_step.norm() > 0)) return {};
  const Vec2 direction = mean_step.normalized();
  double misfit = 0;
  course.between(at, from, to, [&](const Sample& s, double) {
    const double off = cross(direction, s.place - mean);
    misfit += s.weight * off * off;
  });
  return {mean, direction, std::sqrt(misfit / weights)};
}

struct Corner {
  double length;
  Vec2 place;
  double turn;
};

// Returns the corner at a length, with turn 0 if there is none.
Corner corner_at(const Course& course, double at, const FairCurveOptions& options) {
  constexpr double least_turn = std::numbers::pi / 4;
  const double skip = .5 * options.spacing, reach = 1.3 * options.window, roughest = .25 * options.spacing;
  const Side before = side_of(course, at, at - reach, at - skip),
             after = side_of(course, at, at + skip, at + reach);
  if (before.misfit > roughest || after.misfit > roughest) return {at, {}, 0};
  const double sine = cross(before.direction, after.direction);
  const double turn = std::abs(std::atan2(sine, before.direction.dot(after.direction)));
  if (turn < least_turn || turn > 3) return {at, {}, 0};
  const double share = cross(after.point - before.point, after.direction) / sine;
  return {at, before.point + share * before.direction, turn};
}

// Returns the corners in the order of their length: the sharpest within a window.
std::vector<Corner> corners_of(const Course& course, const FairCurveOptions& options) {
  std::vector<Corner> found, corners;
  const auto steps = std::max<std::size_t>(1, std::lround(course.length() / (.5 * options.spacing)));
  for (std::size_t k = 0; k < steps; ++k) {
    const Corner corner = corner_at(
        course, course.begin() + course.length() * static_cast<double>(k) / static_cast<double>(steps),
        options);
    const Vec2 drawn_place = fitted(course, corner.length, {-1e300, 1e300}, options.window);
    if (corner.turn > 0 && (corner.place - drawn_place).norm() < 2 * options.spacing) found.push_back(corner);
  }
  const auto apart = [&](const Corner& a, const Corner& b) {
    const double d = std::abs(a.length - b.length);
    return course.is_closed() ? std::min(d, course.length() - d) : d;
  };
  std::ranges::stable_sort(found, [](const Corner& a, const Corner& b) { return a.turn > b.turn; });
  for (const Corner& c : found)
    if (std::ranges::all_of(corners, [&](const Corner& k) { return apart(c, k) > 1.5 * options.window; }))
      corners.push_back(c);
  std::ranges::sort(corners, {}, &Corner::length);
  return corners;
}

// Adds the points of a piece, its end excluded; its begin is the corner, if there is one.
void add_piece(const Course& course, const Piece& piece, const Corner* corner,
               const FairCurveOptions& options, FairCurve& curve) {
  const double length = piece.to - piece.from;
  const auto steps = std::max<std::size_t>(1, std::lround(length / options.spacing));
  for (std::size_t k = 0; k < steps; ++k) {
    const double at = piece.from + length * static_cast<double>(k) / static_cast<double>(steps);
    const bool is_corner = k == 0 && corner;
    curve.points.push_back(is_corner ? corner->place : fitted(course, at, piece, options.window));
    curve.is_corner.push_back(is_corner);
  }
}

FairCurve curve_of(const Course& course, const FairCurveOptions& options) {
  FairCurve curve;
  const std::vector<Corner> corners = corners_of(course, options);
  if (corners.empty() && course.is_closed()) {
    const auto steps = static_cast<double>(std::lround(course.length() / options.spacing));
    for (double k = 0; k < steps; ++k) {
      curve.points.push_back(fitted(course, k / steps * course.length(), {-1e300, 1e300}, options.window));
      curve.is_corner.push_back(0);
    }
    return curve;
  }
  if (!course.is_closed()) {
    double from = course.begin();
    const Corner* begin = nullptr;
    for (const Corner& c : corners)
      add_piece(course, {from, c.length}, begin, options, curve), from = c.length, begin = &c;
    add_piece(course, {from, course.end()}, begin, options, curve);
    curve.points.push_back(fitted(course, course.end(), {from, course.end()}, options.window));
    curve.is_corner.push_back(0);
    return curve;
  }
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const double to = i + 1 < corners.size() ? corners[i + 1].length : corners[0].length + course.length();
    add_piece(course, {corners[i].length, to}, &corners[i], options, curve);
  }
  return curve;
}

}  // namespace

FairCurve fair_curve(std::span<const CurveNode> nodes, bool is_closed, const FairCurveOptions& options) {
  if (nodes.size() < (is_closed ? 6 : 3)) return {};
  Course course = course_of(nodes, is_closed);
  for (int pass = 0; pass < 2; ++pass) {
    if (course.length() < 4 * options.spacing) return {};
    course = along(drawn(course, options), course, options);
  }
  return curve_of(course, options);
}

}  // namespace relievo
