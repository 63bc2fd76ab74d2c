#include "relievo/detail.h"

#include <algorithm>

#include "relievo/parallel.h"

namespace relievo {

double height_span(std::span<const double> heights) {
  double lowest = 0, highest = 0;
  for (const double z : heights) {
    lowest = std::min(lowest, z);
    highest = std::max(highest, z);
  }
  return highest - lowest;
}

void add_detail(std::span<double> heights, const DetailInput& input) {
  const double amount = input.gamma * height_span(heights);
  parallel_for(heights.size(), [&](std::size_t i) {
    heights[i] += amount * static_cast<double>(input.k[i]) * static_cast<double>(input.boundary_weight[i]);
  });
}

}  // namespace relievo
