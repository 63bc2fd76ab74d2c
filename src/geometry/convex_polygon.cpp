#include "geometry/plane.h"

#include <cstddef>

namespace relievo {
namespace {

constexpr double shortest_mm = 1e-4;  // shorter sides are invisible

// The line of points p with p.dot(normal) == offset.
struct Line {
  Vec2 normal;  // unit length, outwards
  double offset = 0;
};

Vec2 crossing(const Line& a, const Line& b) {
  const double sine = cross(a.normal, b.normal);
  return Vec2(a.offset * b.normal.y() - b.offset * a.normal.y(),
              b.offset * a.normal.x() - a.offset * b.normal.x()) /
         sine;
}

// Returns the length of `side` between its intersections with the lines `before` and `after`. It is negative
// if these two lines intersect each other before they reach the side.
double length_of(const Line& before, const Line& side, const Line& after) {
  const Vec2 along(-side.normal.y(), side.normal.x());
  return (crossing(side, after) - crossing(before, side)).dot(along);
}

// Removes the sides shorter than `shortest_mm`. A removal changes the lengths of the neighbouring sides, so
// the loop then goes back by one side. It ends after a whole round without a removal.
void drop_short(std::vector<Line>& lines) {
  for (std::size_t i = 0, good = 0; good < lines.size() && lines.size() > 3;) {
    const std::size_t n = lines.size();
    i %= n;
    if (length_of(lines[(i + n - 1) % n], lines[i], lines[(i + 1) % n]) >= shortest_mm) {
      ++i, ++good;
      continue;
    }
    lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(i));
    i = i > 0 ? i - 1 : lines.size() - 1;
    good = 0;
  }
}

}  // namespace

std::vector<Vec2> inset(std::span<const Vec2> polygon, double mm) {
  const std::size_t n = polygon.size();
  if (mm == 0) return {polygon.begin(), polygon.end()};
  std::vector<Line> lines;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 along = (polygon[(i + 1) % n] - polygon[i]).normalized();
    const Vec2 normal(along.y(), -along.x());
    lines.push_back({normal, normal.dot(polygon[i]) - mm});
  }
  drop_short(lines);
  std::vector<Vec2> moved;
  for (std::size_t i = 0; i < lines.size(); ++i)
    moved.push_back(crossing(lines[(i + lines.size() - 1) % lines.size()], lines[i]));
  return moved;
}

bool is_within(const Vec2& place, std::span<const Vec2> polygon, double depth) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 side = polygon[(i + 1) % polygon.size()] - polygon[i], to_place = place - polygon[i];
    if (cross(side, to_place) < depth * side.norm()) return false;
  }
  return true;
}

}  // namespace relievo
