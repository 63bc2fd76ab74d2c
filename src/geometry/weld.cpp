#include "geometry/weld.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace relievo {

std::vector<Index> first_coincident(std::span<const Vec3> points) {
  std::vector<Index> order(points.size()), first(points.size());
  std::iota(order.begin(), order.end(), Index{0});
  const auto key = [&](Index i) { return std::tuple(points[i].x(), points[i].y(), points[i].z(), i); };
  std::ranges::sort(order, [&](Index a, Index b) { return key(a) < key(b); });
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool is_coincident = k > 0 && points[order[k]] == points[order[k - 1]];
    first[order[k]] = is_coincident ? first[order[k - 1]] : order[k];
  }
  return first;
}

}  // namespace relievo
