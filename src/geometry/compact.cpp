#include "geometry/compact.h"

namespace relievo {

UsedPoints compact(std::size_t point_count, std::span<Triangle> triangles) {
  UsedPoints used{{}, std::vector<Index>(point_count, no_index)};
  for (const Triangle& t : triangles)
    for (const Index i : t) used.new_number[i] = 0;
  for (Index i = 0; i < point_count; ++i) {
    if (used.new_number[i] == no_index) continue;
    used.new_number[i] = static_cast<Index>(used.points.size());
    used.points.push_back(i);
  }
  for (Triangle& t : triangles)
    for (Index& i : t) i = used.new_number[i];
  return used;
}

std::vector<std::uint8_t> used_points(std::size_t point_count, std::span<const Triangle> triangles) {
  std::vector<std::uint8_t> is_used(point_count, 0);
  for (const Triangle& t : triangles)
    for (const Index i : t) is_used[i] = 1;
  return is_used;
}

Box used_box(std::span<const Vec3> points, std::span<const Triangle> triangles) {
  Box box;
  for (const Triangle& t : triangles)
    for (const Index i : t) box.extend(points[i]);
  return box;
}

}  // namespace relievo
