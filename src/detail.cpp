#include "relievo/detail.h"

#include "relief/height_span.h"

namespace relievo {

double height_span(std::span<const double> heights) {
  return span_of(heights).size();
}

void add_detail(std::span<double> heights, const DetailInput& input) {
  const double amount = input.gamma * height_span(heights);
  parallel_for(heights.size(), [&](std::size_t i) {
    heights[i] += amount * static_cast<double>(input.k[i]) * static_cast<double>(input.boundary_weight[i]);
  });
}

}  // namespace relievo
