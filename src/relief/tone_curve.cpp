#include "relievo/relief/tone_curve.h"

#include <algorithm>
#include <cmath>

#include "core/number.h"
#include "relievo/core/text.h"

namespace relievo {
namespace {

bool is_share(double x) {
  return x >= 0 && x <= 1;
}

// Returns the slopes of the curve at the points. With these slopes the curve stays between the values at the ends of
// each interval. A slope is the weighted harmonic mean of the slopes of both adjacent chords, or 0 at an extremum.
// Source: Fritsch and Butland, A method for constructing local monotone piecewise cubic interpolants, 1984.
std::vector<double> monotone_slopes(const std::vector<Vec2>& points) {
  std::vector<double> slopes(points.size(), 0.0);
  const auto step = [&](std::size_t i) -> Vec2 { return points[i + 1] - points[i]; };
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const Vec2 before = step(i - 1), after = step(i);
    const double d0 = before.y() / before.x(), d1 = after.y() / after.x();
    if (d0 * d1 <= 0) continue;
    const double w0 = 2 * after.x() + before.x(), w1 = after.x() + 2 * before.x();
    slopes[i] = (w0 + w1) / (w0 / d0 + w1 / d1);
  }
  if (points.size() < 2) return slopes;
  const Vec2 first = step(0), last = step(points.size() - 2);
  slopes.front() = first.y() / first.x();
  slopes.back() = last.y() / last.x();
  return slopes;
}

std::optional<double> parse_number(std::string_view text) {
  const auto [number, end, problem] = parse_double(text);
  if (problem != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

}  // namespace

ToneCurve::ToneCurve(std::vector<Vec2> points)
    : points_(std::move(points)), slopes_(monotone_slopes(points_)) {}

Result<ToneCurve> ToneCurve::through(std::vector<Vec2> points) {
  if (points.empty() || points.size() > most_points)
    return option_error("tone", cat("expected 1 to ", most_points, " points, found ", points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!is_share(points[i].x()) || !is_share(points[i].y()))
      return option_error("tone",
                          cat("expected numbers from 0 to 1, found ", points[i].x(), ",", points[i].y()));
    if (i > 0 && !(points[i].x() > points[i - 1].x()))
      return option_error("tone", cat("expected points from left to right, found ", points[i].x(), " after ",
                                      points[i - 1].x()));
  }
  return ToneCurve(std::move(points));
}

double ToneCurve::operator()(double k) const {
  const double x = std::sqrt(std::abs(k));
  const auto next = std::upper_bound(points_.begin(), points_.end(), x,
                                     [](double value, const Vec2& point) { return value < point.x(); });
  if (next == points_.begin()) return points_.front().y();
  if (next == points_.end()) return points_.back().y();
  const auto i = static_cast<std::size_t>(next - points_.begin()) - 1;
  const Vec2 &p = points_[i], &q = points_[i + 1];
  const double width = q.x() - p.x(), t = (x - p.x()) / width, s = 1 - t;
  const double y = s * s * (1 + 2 * t) * p.y() + t * t * (1 + 2 * s) * q.y() +
                   width * s * t * (s * slopes_[i] - t * slopes_[i + 1]);
  return std::clamp(y, std::min(p.y(), q.y()), std::max(p.y(), q.y()));
}

Result<ToneCurve> parse_tone_curve(std::string_view text) {
  std::vector<Vec2> points;
  while (!text.empty() && points.size() <= ToneCurve::most_points) {
    const std::string_view pair = text.substr(0, text.find(';'));
    text.remove_prefix(std::min(text.size(), pair.size() + 1));
    const std::size_t comma = std::min(pair.find(','), pair.size());
    const auto x = parse_number(pair.substr(0, comma));
    const auto y = parse_number(pair.substr(std::min(comma + 1, pair.size())));
    if (!x || !y)
      return option_error("tone", cat("expected pairs X,Y with semicolons between, found '", pair, "'"));
    points.emplace_back(*x, *y);
  }
  return ToneCurve::through(std::move(points));
}

}  // namespace relievo
