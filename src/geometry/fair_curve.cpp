#include "geometry/fair_curve.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "geometry/plane.h"
#include "relievo/core/parallel.h"

namespace relievo {
namespace {

// A node of the curve. `length` is the position of the node along the curve.
struct Sample {
  double length;
  Vec2 place;
  double weight;
};

// The samples in the order of their length along the curve. If the curve is closed, they repeat periodically.
class Course {
 public:
  Course(std::vector<Sample> samples, double begin, double end, bool is_closed)
      : begin_(begin), end_(end), is_closed_(is_closed) {
    std::ranges::stable_sort(samples, {}, &Sample::length);
    samples_ = std::move(samples);
  }

  double begin() const { return begin_; }
  double end() const { return end_; }
  double length() const { return end_ - begin_; }
  // Divides the course into `steps` equal steps. Returns the length along the course at the beginning of step
  // k.
  double at(std::size_t k, std::size_t steps) const {
    return begin_ + length() * static_cast<double>(k) / static_cast<double>(steps);
  }
  bool is_closed() const { return is_closed_; }
  std::vector<Sample>& samples() { return samples_; }

  // Calls use(sample, distance along the curve from `at`) for the samples with lengths between `from` and
  // `to`.
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

// A point where the course turns sharply.
struct Corner {
  double length;
  Vec2 place;
  double turn;
  Vec2 before = {}, after = {};  // points on the two sides of the corner
};

// The part of a course whose samples a fit may use: from one corner to the next, or all of the course if there are no
// corners.
struct CurveSection {
  double from = -1e300, to = 1e300;
  const Corner *begin = nullptr, *end = nullptr;
};

double kernel(double share) {
  const double rest = std::max(0.0, 1 - share * share);
  return rest * rest;
}

// Returns the position of the sample that is nearest to length `at`.
Vec2 nearest_place(const Course& course, double at) {
  Vec2 place = Vec2::Zero();
  double least = 1e300;
  course.between(at, at - course.length(), at + course.length(), [&](const Sample& s, double distance) {
    if (std::abs(distance) < least) least = std::abs(distance), place = s.place;
  });
  return place;
}

// Fits a quadratic to the samples near length `at`. Returns its position at this length. If there are no samples near,
// for example between two close corners, returns the position of the nearest sample.
Vec2 fitted(const Course& course, double at, const CurveSection& section, double window) {
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
    course.between(at, std::max(section.from, at - window), std::min(section.to, at + window), add);
    const double firm = 10 * moments(0, 0);
    if (section.begin) add({section.from, section.begin->place, firm}, section.from - at);
    if (section.end) add({section.to, section.end->place, firm}, section.to - at);
    if (count >= enough) break;
  }
  if (!(moments(0, 0) > 0)) return nearest_place(course, at);
  // Small terms on the diagonal keep the system regular if samples are few.
  moments(1, 1) += 1e-6 * moments(0, 0);
  moments(2, 2) += 1e-3 * moments(0, 0);
  return moments.ldlt().solve(products).row(0).transpose();
}

// Returns the nodes as a course. Lengths are measured along the smoothed polyline of the nodes, because the
// zigzag of the nodes themselves would add length.
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

// Returns evenly spaced points of the course, including both ends if it is open.
std::vector<Vec2> drawn(const Course& course, const FairCurveOptions& options) {
  const auto steps = std::max<std::size_t>(8, std::lround(course.length() / (.5 * options.spacing)));
  const CurveSection whole = course.is_closed() ? CurveSection{} : CurveSection{course.begin(), course.end()};
  std::vector<Vec2> line(steps + (course.is_closed() ? 0 : 1));
  parallel_for(
      line.size(),
      [&](std::size_t k) { line[k] = fitted(course, course.at(k, steps), whole, options.window); }, 64);
  return line;
}

// Returns a course of the same samples whose lengths are measured along `line`, a polyline drawn from the old
// course. Samples far from the line get little weight.
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

// A straight line fitted to samples.
struct Side {
  Vec2 point, direction;
  double misfit = 1e300;  // root mean square distance of the samples from the line
  double curvature = 0;   // curvature of the samples relative to the line
  double turn_error = 0;  // standard deviation of the direction, in radians
};

Side side_of(const Course& course, double at, double from, double to) {
  Vec2 mean = Vec2::Zero(), mean_step = Vec2::Zero();
  double weights = 0, mean_length = 0;
  std::size_t count = 0;
  course.between(at, from, to, [&](const Sample& s, double distance) {
    mean += s.weight * s.place, mean_length += s.weight * distance, weights += s.weight, ++count;
  });
  if (count < 4 || !(weights > 0)) return {};
  mean /= weights, mean_length /= weights;
  double spread = 0;
  course.between(at, from, to, [&](const Sample& s, double distance) {
    mean_step += s.weight * (distance - mean_length) * (s.place - mean);
    spread += s.weight * (distance - mean_length) * (distance - mean_length);
  });
  if (!(mean_step.norm() > 0)) return {};
  const Vec2 direction = mean_step.normalized();
  double misfit = 0, bend = 0, bend_unit = 0;
  course.between(at, from, to, [&](const Sample& s, double distance) {
    const double off = cross(direction, s.place - mean);
    const double along_sq = (distance - mean_length) * (distance - mean_length) - spread / weights;
    misfit += s.weight * off * off;
    bend += s.weight * off * along_sq;
    bend_unit += s.weight * along_sq * along_sq;
  });
  return {mean, direction, std::sqrt(misfit / weights), 2 * bend / std::max(bend_unit, 1e-300),
          std::sqrt(misfit / spread / static_cast<double>(count - 2))};
}

// Fits straight sides to the samples at most `reach` before `at` and at most `reach` after it. Returns the
// corner between the two sides; its turn is 0 if there is no corner. There is a corner if the direction turns
// by more than the sides' curvature and the scatter of their samples explain.
Corner corner_between(const Course& course, double at, double reach, const FairCurveOptions& options) {
  constexpr double least_turn = std::numbers::pi / 4, most_turn = 110 * std::numbers::pi / 180;
  constexpr double sure = 3;  // least excess of the turn over its limits, in standard deviations
  const double skip = .5 * options.spacing, roughest = .6 * options.spacing;
  const Side before = side_of(course, at, at - reach, at - skip),
             after = side_of(course, at, at + skip, at + reach);
  if (before.misfit > roughest || after.misfit > roughest) return {at, {}, 0};
  const double sine = cross(before.direction, after.direction);
  const double turn = std::abs(std::atan2(sine, before.direction.dot(after.direction)));
  const double error = std::hypot(before.turn_error, after.turn_error);
  const double smooth = (std::abs(before.curvature) + std::abs(after.curvature)) / 2 * (reach + skip);
  if (turn < least_turn + smooth + sure * error || turn > most_turn) return {at, {}, 0};
  const double share = cross(after.point - before.point, after.direction) / sine;
  return {at, before.point + share * before.direction, turn, before.point, after.point};
}

// Returns the corner at a length along the course; its turn is 0 if there is no corner. Long sides are tried first,
// because they determine the corner's position best.
Corner corner_at(const Course& course, double at, const FairCurveOptions& options) {
  for (const double windows : {4.0, 2.3, 1.3}) {
    const Corner corner = corner_between(course, at, windows * options.window, options);
    if (corner.turn > 0) return corner;
  }
  return {at, {}, 0};
}

double distance_from(const Vec2& place, const Vec2& from, const Vec2& to) {
  const Vec2 along = to - from;
  const double share =
      std::clamp((place - from).dot(along) / std::max(along.squaredNorm(), 1e-300), 0.0, 1.0);
  return (place - from - share * along).norm();
}

double distance_from_line(const Vec2& place, std::span<const Vec2> line) {
  double nearest = 1e300;
  for (std::size_t k = 1; k < line.size(); ++k)
    nearest = std::min(nearest, distance_from(place, line[k - 1], line[k]));
  return nearest;
}

// Returns whether the samples near a corner are about as close to the corner's sides as to the smooth curve.
// At the tip of a round shape the samples are farther from the sides, because the sides intersect beyond the
// tip.
bool is_confirmed(const Course& course, const Corner& c, std::span<const Vec2> drawn, double window) {
  // The limit of the ratio between two sums of squared distances of the samples: from the sides, and from the
  // curve. The ratio reaches 10 at corners of noisy gears.
  constexpr double scatter = 12;
  const auto n = static_cast<std::ptrdiff_t>(drawn.size());
  const double per_length = static_cast<double>(n) / course.length();
  const auto middle = static_cast<std::ptrdiff_t>((c.length - course.begin()) * per_length),
             reach = static_cast<std::ptrdiff_t>(2 * window * per_length);
  std::vector<Vec2> curve;
  for (std::ptrdiff_t k = middle - reach; k <= middle + reach; ++k)
    if (course.is_closed() || (k >= 0 && k < n))
      curve.push_back(drawn[static_cast<std::size_t>((k % n + n) % n)]);
  const std::array sides{c.before, c.place, c.after};
  double from_sides = 0, from_curve = 0;
  course.between(c.length, c.length - window, c.length + window, [&](const Sample& s, double) {
    const double side = distance_from_line(s.place, sides), off = distance_from_line(s.place, curve);
    from_sides += s.weight * side * side;
    from_curve += s.weight * off * off;
  });
  return from_sides < scatter * from_curve;
}

// Returns the corners in their order along the course. Of corners that are closer together than 1.5 windows,
// only the sharpest is returned. Corner::length is the length at that place of the drawn curve which is
// nearest to the corner.
std::vector<Corner> corners_of(const Course& course, FairCurveOptions options) {
  options.window = options.corner_window;
  const auto steps = std::max<std::size_t>(1, std::lround(course.length() / (.5 * options.spacing)));
  std::vector<Corner> found(steps), corners;
  std::vector<double> lengths(steps);
  std::vector<Vec2> drawn(steps);
  parallel_for(
      steps,
      [&](std::size_t k) {
        lengths[k] = course.at(k, steps);
        drawn[k] = fitted(course, lengths[k], {}, options.window);
        found[k] = corner_at(course, lengths[k], options);
        const bool is_near = found[k].turn > 0 && (found[k].place - drawn[k]).norm() < options.window;
        if (!is_near) found[k].turn = 0;
      },
      64);
  std::erase_if(found, [&](const Corner& corner) {
    return corner.turn == 0 || !is_confirmed(course, corner, drawn, options.window);
  });
  const auto apart = [&](double a, double b) {
    const double d = std::abs(a - b);
    return course.is_closed() ? std::min(d, course.length() - d) : d;
  };
  std::ranges::stable_sort(found, [](const Corner& a, const Corner& b) { return a.turn > b.turn; });
  for (Corner& c : found) {
    double nearest = 1e300, length = c.length;
    for (std::size_t k = 0; k < steps; ++k)
      if (apart(lengths[k], c.length) < options.window && (drawn[k] - c.place).norm() < nearest)
        nearest = (drawn[k] - c.place).norm(), length = lengths[k];
    c.length = length;
    if (std::ranges::all_of(
            corners, [&](const Corner& k) { return apart(c.length, k.length) > 1.5 * options.window; }))
      corners.push_back(c);
  }
  std::ranges::stable_sort(corners, {}, &Corner::length);
  return corners;
}

// Adds the points of a section to the curve. The section's end is left out.
void add_section(const Course& course, const CurveSection& section, const FairCurveOptions& options,
                 FairCurve& curve) {
  const double length = section.to - section.from;
  const auto steps = std::max<std::size_t>(1, std::lround(length / options.spacing));
  for (std::size_t k = 0; k < steps; ++k) {
    const double at = section.from + length * static_cast<double>(k) / static_cast<double>(steps);
    const bool is_corner = k == 0 && section.begin;
    curve.points.push_back(is_corner ? section.begin->place : fitted(course, at, section, options.window));
    curve.is_corner.push_back(is_corner);
  }
}

FairCurve curve_of(const Course& course, const FairCurveOptions& options) {
  FairCurve curve;
  const std::vector<Corner> corners = corners_of(course, options);
  if (!course.is_closed()) {
    CurveSection section{course.begin(), course.end()};
    for (const Corner& c : corners) {
      add_section(course, {section.from, c.length, section.begin, &c}, options, curve);
      section.from = c.length, section.begin = &c;
    }
    add_section(course, section, options, curve);
    curve.points.push_back(fitted(course, course.end(), section, options.window));
    curve.is_corner.push_back(0);
    return curve;
  }
  if (corners.empty()) {
    const auto steps = static_cast<double>(std::lround(course.length() / options.spacing));
    for (double k = 0; k < steps; ++k)
      curve.points.push_back(fitted(course, k / steps * course.length(), {}, options.window));
    curve.is_corner.resize(curve.points.size(), 0);
    return curve;
  }
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const bool is_last = i + 1 == corners.size();
    const Corner& next = corners[is_last ? 0 : i + 1];
    const double to = next.length + (is_last ? course.length() : 0);
    add_section(course, {corners[i].length, to, &corners[i], &next}, options, curve);
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
