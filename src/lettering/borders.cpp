#include "geometry/plane.h"
#include "lettering/ornament_shapes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace relievo {
namespace {

// Sizes as shares of the row's width: the distances between neighbouring beads and between neighbouring
// strands, and the longer and the shorter half axis of a strand.
constexpr double bead_step = 1.5, strand_step = .8, strand_length = .62, strand_width = .27;
constexpr double strand_turn = std::numbers::pi / 4;
constexpr int piece_corners = 32;

struct PlaceOnPath {
  Vec2 place, along;
};

// Returns points at equal distances along the closed path.
std::vector<PlaceOnPath> places_on(const BorderRow& row, double step) {
  double length = 0;
  const auto side = [&](std::size_t i) -> Vec2 { return row.path[(i + 1) % row.path.size()] - row.path[i]; };
  for (std::size_t i = 0; i < row.path.size(); ++i) length += side(i).norm();
  const int count = static_cast<int>(row.count > 0 ? row.count : std::max(3.0, std::floor(length / step)));
  std::vector<PlaceOnPath> places;
  double before = 0;
  for (std::size_t i = 0; i < row.path.size(); ++i) {
    const double here = side(i).norm();
    for (double at = length * static_cast<double>(places.size()) / count;
         at < before + here && static_cast<int>(places.size()) < count;
         at = length * static_cast<double>(places.size()) / count)
      places.push_back({row.path[i] + (at - before) / here * side(i), side(i) / here});
    before += here;
  }
  return places;
}

// Returns ellipses at the given points. `length` and `width` are their half axes; `turn` is the angle from
// the path to the longer axis.
Outlines ellipses(const std::vector<PlaceOnPath>& places, double length, double width, double turn) {
  Outlines outlines;
  for (const auto& [place, along] : places) {
    const Vec2 u = Eigen::Rotation2D<double>(turn) * along, v(-u.y(), u.x());
    std::vector<Vec2>& outline = outlines.emplace_back();
    for (int k = 0; k < piece_corners; ++k) {
      const double angle = 2 * std::numbers::pi * k / piece_corners;
      outline.emplace_back(place + length * std::cos(angle) * u + width * std::sin(angle) * v);
    }
  }
  return outlines;
}

}  // namespace

Outlines line_outlines(std::span<const Vec2> polygon, double before_mm, double width_mm) {
  std::vector<Vec2> within = inset(polygon, before_mm + width_mm);
  std::ranges::reverse(within);
  return {inset(polygon, before_mm), std::move(within)};
}

Outlines bead_outlines(const BorderRow& row) {
  const double radius = row.width_mm / 2;
  return ellipses(places_on(row, bead_step * row.width_mm), radius, radius, 0);
}

double bead_radius(const BorderRow& row) {
  return row.width_mm / 2 * std::cos(std::numbers::pi / piece_corners);
}

Outlines rope_outlines(const BorderRow& row) {
  return ellipses(places_on(row, strand_step * row.width_mm), strand_length * row.width_mm,
                  strand_radius(row), strand_turn);
}

double strand_radius(const BorderRow& row) {
  return strand_width * row.width_mm;
}

}  // namespace relievo
