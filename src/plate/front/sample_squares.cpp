#include "plate/front/sample_front.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace relievo {
namespace {

// The curvature counts as even where the angle between neighbouring cells changes by at most this share of
// the angle. Elsewhere, as on rough surfaces, the curvature is uneven, and facets are invisible.
constexpr float most_change = .25F;
// If the angle between neighbouring cells is at least this many facet angles, there is a crease between them.
// Smaller facets would not make it smoother.
constexpr float crease = 3;

// Returns the sine of the angle between the normals of two slopes.
float turn_between(const Vec2f& a, const Vec2f& b) {
  const float across = a.x() * b.y() - a.y() * b.x();
  return std::sqrt(((a - b).squaredNorm() + across * across) /
                   ((1 + a.squaredNorm()) * (1 + b.squaredNorm())));
}

// Returns whether the surface bends evenly over three consecutive cells, and by more than `facet_angle` per
// cell, so that the cells must be smaller. Returns false at a crease.
bool turns_evenly(const Vec2f& before, const Vec2f& middle, const Vec2f& after, float facet_angle) {
  const float turn = turn_between(before, after) / 2, change = turn_between(before + after - middle, middle);
  return turn > facet_angle && turn < crease * facet_angle && change < most_change * turn;
}

struct SlopeRange {
  Vec2f least = Vec2f::Constant(std::numeric_limits<float>::infinity()), most = -least;

  void extend(const SlopeRange& other) {
    least = least.cwiseMin(other.least);
    most = most.cwiseMax(other.most);
  }
  float turn() const { return turn_between(least, most); }
};

// All squares of one size: their slopes, and whether each is used.
struct Level {
  Image<SlopeRange> ranges;
  Image<std::uint8_t> is_used;

  Level(int width, int height)
      : ranges(filled_image(width, height, SlopeRange())),
        is_used(filled_image(width, height, std::uint8_t{0})) {}
};

Level cells_of(const Image<Vec2f>& slopes) {
  Level cells(slopes.width, slopes.height);
  for (std::size_t i = 0; i < slopes.pixels.size(); ++i) {
    const Vec2f& slope = slopes.pixels[i];
    if (!slope.allFinite()) continue;
    cells.ranges.pixels[i] = {slope, slope};
    cells.is_used.pixels[i] = 1;
  }
  return cells;
}

// Returns whether the four squares that form a larger square, and all squares of their size around it,
// are used. Otherwise the larger square could be four times as wide as a neighbour.
bool can_be_joined(const Level& parts, int x, int y) {
  for (int py = 2 * y - 2; py < 2 * y + 4; ++py)
    for (int px = 2 * x - 2; px < 2 * x + 4; ++px)
      if (!parts.is_used.at(px, py)) return false;
  return true;
}

// Joins four squares to a larger square wherever the surface turns by at most `most` across the larger
// square. The four squares are then marked as unused.
Level joined(Level& parts, float most) {
  Level whole(parts.ranges.width / 2, parts.ranges.height / 2);
  for (int y = 0; y < whole.ranges.height; ++y)
    for (int x = 0; x < whole.ranges.width; ++x)
      for (int k = 0; k < 4; ++k) whole.ranges.at(x, y).extend(parts.ranges.at(2 * x + k % 2, 2 * y + k / 2));
  for (int y = 1; y + 1 < whole.ranges.height; ++y)
    for (int x = 1; x + 1 < whole.ranges.width; ++x)
      whole.is_used.at(x, y) = whole.ranges.at(x, y).turn() <= most && can_be_joined(parts, x, y);
  for (int y = 0; y < whole.ranges.height; ++y)
    for (int x = 0; x < whole.ranges.width; ++x)
      if (whole.is_used.at(x, y))
        for (int k = 0; k < 4; ++k) parts.is_used.at(2 * x + k % 2, 2 * y + k / 2) = 0;
  return whole;
}

bool is_quartered(const Image<Vec2f>& slopes, int x, int y, float facet_angle) {
  if (x == 0 || y == 0 || x + 1 == slopes.width || y + 1 == slopes.height) return false;
  const auto slope = [&](int dx, int dy) -> const Vec2f& { return slopes.at(x + dx, y + dy); };
  const auto is_even = [&](int dx, int dy) {
    return turns_evenly(slope(-dx, -dy), slope(0, 0), slope(dx, dy), facet_angle);
  };
  return is_even(1, 0) || is_even(0, 1);
}

// Tolerance of the distance between the midpoints of a rectangle's diagonals, as a share of the diagonals'
// length. The distance is not 0, because grid positions are rounded.
constexpr double rounding = 1e-6;

bool is_rectangle(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const double length = (c - a).norm();
  return (a + c - b - d).norm() < rounding * length && std::abs((d - b).norm() - length) < rounding * length;
}

}  // namespace

std::vector<SampleSquare> sample_squares(const Image<Vec2f>& slopes, float facet_angle) {
  std::vector<Level> levels;
  levels.push_back(cells_of(slopes));
  for (int side = 2; side <= largest_square; side *= 2) {
    // Slopes are known at the centres of cells. The outermost centres of a square are closer together than its sides.
    const float reach = static_cast<float>(side - 1) / static_cast<float>(side);
    levels.push_back(joined(levels.back(), reach * facet_angle));
  }
  std::vector<SampleSquare> squares;
  int side = 1;
  for (const Level& level : levels) {
    for (int y = 0; y < level.is_used.height; ++y)
      for (int x = 0; x < level.is_used.width; ++x)
        if (level.is_used.at(x, y))
          squares.push_back({x * side, y * side, side, side == 1 && is_quartered(slopes, x, y, facet_angle)});
    side *= 2;
  }
  return squares;
}

void turn_diagonals(std::span<const Vec2> points, std::span<const Vec2f> slopes, Triangulation& mesh) {
  // Returns the change of slope along the segment from a to b, times the segment's length.
  const auto bend = [&](Index a, Index b) {
    return std::abs((slopes[b] - slopes[a]).cast<double>().dot(points[b] - points[a]));
  };
  std::vector<std::uint8_t> is_turned(mesh.triangles.size(), 0);
  for (Index t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3 && !is_turned[t]; ++i) {
      const Index other = mesh.neighbours[t][i];
      if (other == no_index || other < t || is_turned[other]) continue;
      const Index apex = mesh.triangles[t][i], from = mesh.triangles[t][(i + 1) % 3],
                  to = mesh.triangles[t][(i + 2) % 3];
      const auto j = static_cast<std::size_t>(std::ranges::find(mesh.neighbours[other], t) -
                                              mesh.neighbours[other].begin());
      const Index opposite = mesh.triangles[other][j];
      if (!is_rectangle(points[from], points[opposite], points[to], points[apex])) continue;
      // If a slope is NaN, the comparison is false, and the diagonal stays.
      if (!(bend(apex, opposite) < bend(from, to))) continue;
      mesh.triangles[t] = {apex, from, opposite};
      mesh.triangles[other] = {opposite, to, apex};
      is_turned[t] = is_turned[other] = 1;
    }
}

}  // namespace relievo
