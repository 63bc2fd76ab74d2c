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

}  // namespace relievo
