// Detail (stage 12): ridges raised, grooves lowered. The paper's second equation (9).
#pragma once

#include <span>

namespace relievo {

struct DetailInput {
  std::span<const float> k;                // normalised mean curvature per point
  std::span<const float> boundary_weight;  // w_b per point: keeps the boundary on the base
  double gamma = 0;                        // detail coefficient
};

// Adds gamma k h w_b to every height, where h is the span of the heights and 0 (the base) before. The paper
// has no w_b.
void add_detail(std::span<double> heights, const DetailInput& input);

// Highest minus lowest of the heights and 0, the base.
double height_span(std::span<const double> heights);

}  // namespace relievo
