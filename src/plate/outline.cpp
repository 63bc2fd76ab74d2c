#include "relievo/plate/outline.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "geometry/plane.h"
#include "relievo/core/text.h"

namespace relievo {
namespace {

using Points = std::span<const Vec2>;

// The largest distance of a curve from its inscribed polygon is the larger of finest_mm and finest_share
// of the radius. finest_mm is below the errors of machining and polishing. finest_share is the precision
// of files; it decides for radii above 9 m.
constexpr double finest_mm = 9e-4, finest_share = 1e-7;

// The distance of a line from the centre, as a function of the outline's size: offset + growth * size.
struct Distance {
  double offset = 0, growth = 1;

  double at(double size) const { return offset + size * growth; }
};

// One side of a convex polygon that approximates the curve of an outline. Polygon and curve grow with the
// size of the outline. `line` is the line of the side. `tangent` is the parallel tangent of the curve. The
// two coincide where the curve is straight.
struct Side {
  Vec2 normal;  // unit length, outwards
  Distance tangent = {}, line = tangent;
};

// The bounding box of points, as its centre and half its size.
struct Frame {
  Vec2 centre = Vec2::Zero(), half = Vec2::Zero();
};

Frame frame_around(Points points) {
  Vec2 min = points[0], max = points[0];
  for (const Vec2& p : points) min = min.cwiseMin(p), max = max.cwiseMax(p);
  return {(min + max) / 2, (max - min) / 2};
}

// A regular polygon with corners on the unit circle. Four of the corners lie on the axes. The sides
// are in counter-clockwise order.
struct CircleSides {
  std::vector<Vec2> normals;  // unit length
  double distance = 1;        // distance of the sides from the centre
};

// Returns a polygon in the unit circle that approximates a circle of the given radius. If it is scaled to this radius,
// its deviation from the circle is at most the larger of finest_mm and finest_share of the radius.
CircleSides circle_sides(double radius) {
  const double widest = 2 * std::acos(1 - std::min(.1, std::max(finest_mm / radius, finest_share)));
  const int steps = std::max(4, static_cast<int>(std::ceil(std::numbers::pi / 2 / widest)));
  const double angle = std::numbers::pi / 2 / steps;
  CircleSides sides{{}, std::cos(angle / 2)};
  for (int i = 0; i < steps; ++i)
    sides.normals.emplace_back(std::cos((i + .5) * angle), std::sin((i + .5) * angle));
  for (std::size_t i = 0; i < 3 * static_cast<std::size_t>(steps); ++i)
    sides.normals.emplace_back(-sides.normals[i].y(), sides.normals[i].x());
  return sides;
}

// Returns the centre of the smallest circle around the points whose centre is midway between the leftmost and
// the rightmost point; other centres could be visibly off this middle. Distances are measured in coordinates
// divided by `scale`, so that the circle can stand for an ellipse.
Vec2 round_centre(Points points, const Vec2& scale) {
  const Frame frame = frame_around(points);
  const auto farthest = [&](double y) {
    double distance_sq = 0;
    for (const Vec2& p : points)
      distance_sq = std::max(distance_sq, (p - Vec2(frame.centre.x(), y)).cwiseQuotient(scale).squaredNorm());
    return distance_sq;
  };
  double low = frame.centre.y() - frame.half.y(), high = frame.centre.y() + frame.half.y();
  const int steps = 100;  // each step shortens the interval to two thirds
  for (int i = 0; i < steps; ++i) {
    const double third = (high - low) / 3;
    if (farthest(low + third) > farthest(high - third))
      low += third;
    else
      high -= third;
  }
  return {frame.centre.x(), (low + high) / 2};
}

std::vector<Side> sides_of_rectangle(const Frame& frame, const OutlineOptions& options, double corner) {
  const Vec2 inner = frame.half + Vec2::Constant(options.margin_mm - corner);
  const CircleSides round = corner > 0 ? circle_sides(corner) : CircleSides();
  const std::size_t steps = round.normals.size() / 4;
  std::vector<Side> sides;
  const auto add = [&](const Vec2& normal, double share) {
    const double straight = inner.dot(normal.cwiseAbs()), growth = normal.cwiseAbs().sum();
    sides.push_back({normal, {straight + corner, growth}, {straight + share * corner, growth}});
  };
  for (std::size_t quarter = 0; const Vec2& axis : {Vec2(1, 0), Vec2(0, 1), Vec2(-1, 0), Vec2(0, -1)}) {
    add(axis, 1);
    for (std::size_t i = 0; i < steps; ++i) add(round.normals[quarter * steps + i], round.distance);
    ++quarter;
  }
  return sides;
}

std::vector<Side> sides_of_ellipse(const Vec2& half, double longest) {
  std::vector<Side> sides;
  const CircleSides round = circle_sides(longest);
  for (const Vec2& d : round.normals) {
    const Vec2 normal = d.cwiseQuotient(half).normalized();
    const double growth = normal.cwiseProduct(half).norm();
    sides.push_back({normal, {0, growth}, {0, round.distance * growth}});
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

// Returns the smallest size at which the distance of the curve from every point is at least the margin.
double size_around(Points points, const Vec2& centre, const std::vector<Side>& sides, double margin_mm) {
  double size = 0;
  for (const Side& side : sides) {
    double farthest = (points[0] - centre).dot(side.normal);
    for (const Vec2& p : points) farthest = std::max(farthest, (p - centre).dot(side.normal));
    size = std::max(size, (farthest + margin_mm - side.tangent.offset) / side.tangent.growth);
  }
  return size;
}

std::vector<Vec2> to_polygon(const std::vector<Side>& sides, const Vec2& centre, double size) {
  // Corners nearer than this length to the previous corner are left out. Two arcs meet in one point if the
  // straight side between them has no length.
  constexpr double least_side_mm = 1e-4;
  std::vector<Vec2> polygon;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const Side &a = sides[i], &b = sides[(i + 1) % sides.size()];
    const double p = a.line.at(size), q = b.line.at(size), sine = cross(a.normal, b.normal);
    const Vec2 corner =
        centre + Vec2(p * b.normal.y() - q * a.normal.y(), q * a.normal.x() - p * b.normal.x()) / sine;
    if (polygon.empty() || (corner - polygon.back()).norm() >= least_side_mm) polygon.push_back(corner);
  }
  if ((polygon.front() - polygon.back()).norm() < least_side_mm) polygon.pop_back();
  return polygon;
}

std::vector<Vec2> around(Points points, const Vec2& centre, const std::vector<Side>& sides,
                         double margin_mm) {
  return to_polygon(sides, centre, size_around(points, centre, sides, margin_mm));
}

// Returns the bounding box of the points. If the options have a size, returns a box with the same centre
// instead. Its size is that of the options minus the margin on all sides.
Frame inner_frame(Points points, const OutlineOptions& options) {
  Frame frame = frame_around(points);
  if (options.size_mm.x() > 0) frame.half = options.size_mm / 2 - Vec2::Constant(options.margin_mm);
  return frame;
}

// The corners are sharp unless the outline is Outline::round.
std::vector<Vec2> rectangle_around(Points points, const OutlineOptions& options) {
  const Frame frame = inner_frame(points, options);
  const Vec2 half = frame.half + Vec2::Constant(options.margin_mm);
  const double corner = options.outline == Outline::round ? std::min(options.corner_mm, half.minCoeff()) : 0;
  const std::vector<Side> sides = sides_of_rectangle(frame, options, corner);
  if (options.size_mm.x() > 0) return to_polygon(sides, frame.centre, 0);
  return around(points, frame.centre, sides, options.margin_mm);
}

// Returns an ellipse around the points, with axes in the ratio of `shape`.
std::vector<Vec2> ellipse_of_shape(Points points, const Vec2& shape, const OutlineOptions& options) {
  const Frame frame = frame_around(points);
  const Vec2 centre = round_centre(points, shape), wanted = options.size_mm / 2;
  if (wanted.x() > 0) return to_polygon(sides_of_ellipse(wanted, wanted.maxCoeff()), centre, 1);
  const Vec2 half = frame.half + Vec2::Constant(options.margin_mm);
  // The diagonal of the box exceeds every radius of a circle or ellipse around the points.
  const auto size_with = [&](double longest) {
    return size_around(points, centre, sides_of_ellipse(shape, longest), options.margin_mm);
  };
  const double longest = 1.001 * shape.maxCoeff() * size_with(2 * half.norm());
  return around(points, centre, sides_of_ellipse(shape, longest), options.margin_mm);
}

std::vector<Vec2> circle_around(Points points, const OutlineOptions& options) {
  return ellipse_of_shape(points, Vec2(1, 1), options);
}

std::vector<Vec2> ellipse_around(Points points, const OutlineOptions& options) {
  const bool has_size = options.size_mm.x() > 0;
  return ellipse_of_shape(
      points, has_size ? options.size_mm : frame_around(points).half + Vec2::Constant(options.margin_mm),
      options);
}

std::vector<Vec2> hexagon_around(Points points, const OutlineOptions& options) {
  const double margin = options.margin_mm;
  const Vec2 centre = round_centre(points, Vec2(1, 1));
  const std::vector<Side> flat = sides_of_hexagon(false), pointed = sides_of_hexagon(true);
  const bool is_pointed =
      size_around(points, centre, pointed, margin) < size_around(points, centre, flat, margin);
  return around(points, centre, is_pointed ? pointed : flat, margin);
}

// Properties of an outline, and the function that makes it. Outline::none has no entry in the table.
struct OutlineShape {
  Outline outline;
  std::vector<Vec2> (*around)(Points points, const OutlineOptions& options);
  bool has_free_size = false;
  bool is_box = false;
};

constexpr std::array shapes = {
    OutlineShape{Outline::rectangle, rectangle_around, true, true},
    OutlineShape{Outline::round, rectangle_around, true}, OutlineShape{Outline::circle, circle_around},
    OutlineShape{Outline::ellipse, ellipse_around, true}, OutlineShape{Outline::hexagon, hexagon_around}};

const OutlineShape* shape_of(Outline outline) {
  const auto found = std::ranges::find(shapes, outline, &OutlineShape::outline);
  return found == shapes.end() ? nullptr : &*found;
}

// Returns the numbers before and after the separator as lengths. In "8x6in" only the second number has a
// unit, which then applies to both.
std::optional<Vec2> parse_pair(std::string_view text, char separator, LengthUnit bare) {
  const std::size_t middle = text.find(separator);
  if (middle == std::string_view::npos) return std::nullopt;
  std::string first(text.substr(0, middle));
  const std::string_view second = text.substr(middle + 1);
  const bool has_unit = first.find_first_of("mci\"") != std::string::npos;
  if (!has_unit) first += second.substr(second.find_last_of("0123456789") + 1);
  const Result<double> a = parse_length(first, bare), b = parse_length(second, bare);
  if (!a || !b) return std::nullopt;
  return Vec2(*a, *b);
}

}  // namespace

Result<Vec2> parse_plate_size(std::string_view text, LengthUnit bare) {
  constexpr std::string_view cross_sign = "\u00d7";  // accepted instead of x
  if (const std::size_t at = text.find(cross_sign); at != std::string_view::npos)
    return parse_plate_size(cat(text.substr(0, at), "x", text.substr(at + cross_sign.size())), bare);
  const std::optional<Vec2> size = parse_pair(text, 'x', bare);
  if (size && size->minCoeff() > 0) return *size;
  return option_error({}, cat("expected width and height such as 200x150 or 8in x 6in, found '", text, "'"));
}

Result<Vec2> parse_shift(std::string_view text, LengthUnit bare) {
  const std::optional<Vec2> shift = parse_pair(text, ',', bare);
  if (shift && shift->cwiseAbs().maxCoeff() <= 1e5) return *shift;
  return option_error({}, cat("expected lengths to the right and up such as 10,-5, found '", text, "'"));
}

bool has_free_size(Outline outline) {
  const OutlineShape* const shape = shape_of(outline);
  return shape && shape->has_free_size;
}

bool is_box(Outline outline) {
  const OutlineShape* const shape = shape_of(outline);
  return shape && shape->is_box;
}

std::vector<Vec2> outline_around(std::span<const Vec2> points, const OutlineOptions& options) {
  const OutlineShape* const shape = shape_of(options.outline);
  return shape && !points.empty() ? shape->around(points, options) : std::vector<Vec2>();
}

}  // namespace relievo
