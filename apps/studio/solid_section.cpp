#include "studio/solid_section.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace relievo::app::studio {
namespace {

// A point where an edge of a triangle crosses the plane of the section.
struct Crossing {
  double along, z;  // `along` in multiples of the distance between samples, z in mm
};

// Raises each sample between two crossings to the height of the line through them, if the sample is lower.
void raise(std::vector<float>& heights, Crossing a, Crossing b) {
  if (a.along > b.along) std::swap(a, b);
  const double last = static_cast<double>(heights.size() - 1);
  if (b.along < 0 || a.along > last) return;
  const auto first = static_cast<std::size_t>(std::ceil(std::max(a.along, 0.)));
  for (std::size_t i = first; static_cast<double>(i) <= std::min(b.along, last); ++i) {
    const double length = b.along - a.along,
                 share = length > 0 ? (static_cast<double>(i) - a.along) / length : 1;
    heights[i] = std::max(heights[i], static_cast<float>(a.z + share * (b.z - a.z)));
  }
}

}  // namespace

std::vector<float> section_of(const Solid& solid, const SectionLine& line) {
  const Box box = Box::of(solid.points);
  const Vec2 middle = ((box.min + box.max) / 2).head<2>(), way = line.to - line.from;
  const double length = std::max(way.norm(), 1e-9), steps = static_cast<double>(line.samples - 1);
  const Vec2 along = way.norm() > 0 ? Vec2(way / length) : Vec2(1, 0), across(-along.y(), along.x());
  std::vector<float> heights(line.samples, static_cast<float>(box.min.z() - solid.ground_mm));
  for (const Triangle& triangle : solid.triangles) {
    std::array<Vec2, 3> places;  // coordinates along and across the line
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec2 p = solid.points[triangle[i]].head<2>() - middle - line.from;
      places[i] = {p.dot(along) / length * steps, p.dot(across)};
    }
    std::array<Crossing, 3> crossings{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      if ((places[i].y() < 0) == (places[j].y() < 0)) continue;
      const double share = places[i].y() / (places[i].y() - places[j].y());
      const double a = solid.points[triangle[i]].z(), b = solid.points[triangle[j]].z();
      crossings[count++] = {places[i].x() + share * (places[j].x() - places[i].x()),
                            a + share * (b - a) - solid.ground_mm};
    }
    if (count == 2) raise(heights, crossings[0], crossings[1]);
  }
  return heights;
}

}  // namespace relievo::app::studio
