#include "relievo/plate/outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

namespace relievo {
namespace {

constexpr double finest_mm = .01;  // between a curve and its polygon

// A line that encloses the points: places p with p.dot(normal) <= reach + size * growth.
struct Side {
  Vec2 normal;  // unit length, outwards
  double reach = 0, growth = 1;
};

struct Frame {
  Vec2 centre = Vec2::Zero(), half = Vec2::Zero();
};

Frame frame_of(std::span<const Vec2> points) {
  Vec2 min = points[0], max = points[0];
  for (const Vec2& p : points) min = min.cwiseMin(p), max = max.cwiseMax(p);
  return {(min + max) / 2, (max - min) / 2};
}

// Steps per quarter turn for a polygon around a circle.
int steps_for(double radius) {
  const double widest = 2 * std::acos(radius / (radius + finest_mm));
  return std::max(4, static_cast<int>(std::ceil(std::numbers::pi / 2 / widest)));
}

// Unit vectors all around, counter-clockwise; the four along the axes are exact.
std::vector<Vec2> directions(int steps_per_quarter) {
  std::vector<Vec2> all;
  for (int i = 0; i < steps_per_quarter; ++i) {
    const double angle = std::numbers::pi / 2 * i / steps_per_quarter;
    all.emplace_back(std::cos(angle), std::sin(angle));
  }
  for (std::size_t i = 0; i < 3 * static_cast<std::size_t>(steps_per_quarter); ++i)
    all.emplace_back(-all[i].y(), all[i].x());
  return all;
}

// Bădoiu and Clarkson's walk to the centre of the smallest circle, in a plane stretched by 1 / scale.
Vec2 round_centre(std::span<const Vec2> points, Vec2 centre, const Vec2& scale) {
  const int steps = 4000;
  for (int i = 1; i <= steps; ++i) {
    const Vec2 far = *std::ranges::max_element(
        points, {}, [&](const Vec2& p) { return (p - centre).cwiseQuotient(scale).squaredNorm(); });
    centre += (far - centre) / (i + 1);
  }
  return centre;
}

std::vector<Side> sides_of_rectangle(const Frame& frame, const OutlineOptions& options, double corner) {
  const Vec2 inner = frame.half + Vec2::Constant(options.margin_mm - corner);
  std::vector<Side> sides;
  for (const Vec2& d : directions(corner > 0 ? steps_for(corner) : 1))
    sides.push_back({d, inner.dot(d.cwiseAbs()) + corner, d.cwiseAbs().sum()});
  return sides;
}

std::vector<Side> sides_of_ellipse(const Vec2& half, double longest) {
  std::vector<Side> sides;
  for (const Vec2& d : directions(steps_for(longest))) {
    const Vec2 normal = d.cwiseQuotient(half).normalized();
    sides.push_back({normal, 0, normal.cwiseProduct(half).norm()});
  }
  return sides;
}

std::vector<Side> sides_of_hexagon(bool is_pointed) {
  const double root = std::sqrt(.75);
  std::vector<Side> sides;
  for (const Vec2& d :
       {Vec2(root, .5), Vec2(0, 1), Vec2(-root, .5), Vec2(-root, -.5), Vec2(0, -1), Vec2(root, -.5)})
    sides.push_back({is_pointed ? Vec2(d.y(), -d.x()) : d});
  return sides;
}

// The least size at which every side leaves the margin to every point.
double size_around(std::span<const Vec2> points, const Vec2& centre, const std::vector<Side>& sides,
                   double margin_mm) {
  double size = 0;
  for (const Side& side : sides) {
    double farthest = (points[0] - centre).dot(side.normal);
    for (const Vec2& p : points) farthest = std::max(farthest, (p - centre).dot(side.normal));
    size = std::max(size, (farthest + margin_mm - side.reach) / side.growth);
  }
  return size;
}

std::vector<Vec2> polygon_of(const std::vector<Side>& sides, const Vec2& centre, double size) {
  std::vector<Vec2> polygon;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const Side &a = sides[i], &b = sides[(i + 1) % sides.size()];
    const double p = a.reach + size * a.growth, q = b.reach + size * b.growth;
    const double sine = a.normal.x() * b.normal.y() - a.normal.y() * b.normal.x();
    polygon.push_back(centre +
                      Vec2(p * b.normal.y() - q * a.normal.y(), q * a.normal.x() - p * b.normal.x()) / sine);
  }
  return polygon;
}

std::vector<Vec2> around(std::span<const Vec2> points, const Vec2& centre, const std::vector<Side>& sides,
                         double margin_mm) {
  return polygon_of(sides, centre, size_around(points, centre, sides, margin_mm));
}

std::vector<Vec2> hexagon(std::span<const Vec2> points, const Vec2& centre, double margin_mm) {
  const std::vector<Side> flat = sides_of_hexagon(false), pointed = sides_of_hexagon(true);
  const bool is_pointed =
      size_around(points, centre, pointed, margin_mm) < size_around(points, centre, flat, margin_mm);
  return around(points, centre, is_pointed ? pointed : flat, margin_mm);
}

}  // namespace

Result<Outline> parse_outline(std::string_view name) {
  constexpr std::array<std::string_view, 6> names = {"rectangle", "round",   "circle",
                                                     "ellipse",   "hexagon", "none"};
  const auto found = std::ranges::find(names, name);
  if (found != names.end()) return static_cast<Outline>(found - names.begin());
  return std::unexpected(Error{
      ErrorKind::option,
      "--outline",
      {},
      "expected rectangle, round, circle, ellipse, hexagon or none, found '" + std::string(name) + "'"});
}

std::vector<Vec2> outline_around(std::span<const Vec2> points, const OutlineOptions& options) {
  if (points.empty() || options.outline == Outline::none) return {};
  const Frame frame = frame_of(points);
  const double margin = options.margin_mm;
  const Vec2 half = frame.half + Vec2::Constant(margin);
  const double corner = options.outline == Outline::round ? std::min(options.corner_mm, half.minCoeff()) : 0;
  if (options.outline == Outline::rectangle || options.outline == Outline::round)
    return around(points, frame.centre, sides_of_rectangle(frame, options, corner), margin);
  const Vec2 shape = options.outline == Outline::ellipse ? half : Vec2(1, 1);
  const Vec2 centre = round_centre(points, frame.centre, shape);
  if (options.outline == Outline::hexagon) return hexagon(points, centre, margin);
  // Twice the box's diagonal holds any circle or ellipse that fits the points.
  return around(points, centre, sides_of_ellipse(shape, 2 * half.norm()), margin);
}

}  // namespace relievo
