// Measures the sampling distance (stage 1), which is the spacing of points, locally and overall.
#pragma once

#include <vector>

#include "relievo/scan/cloud.h"

namespace relievo {

inline constexpr std::size_t spacing_neighbours = 8;

struct Spacing {
  // The sampling distance, in the cloud's units. It is the larger of two numbers: the median of `local`, and
  // a quarter of the 98 % quantile of `local`. The second number is larger only in clouds of very uneven
  // density. rho is 0 if there are fewer than 2 points or almost all points coincide.
  double rho = 0;
  bool is_uneven = false;  // whether rho is a quarter of the 98 % quantile
  // The local spacing of each point, sqrt(pi r^2 / k), where r is the distance to the k-th nearest other
  // point and k is spacing_neighbours. It is the side of a square whose area is the area per point. For
  // randomly scattered points it is about twice the distance to the nearest neighbour.
  std::vector<float> local;
  // The indices of each point's k nearest other points, nearest first; no_index if the cloud has fewer.
  std::vector<std::array<Index, spacing_neighbours>> nearest;
};

// Returns the spacing of a cloud. rho and local do not depend on the order of the points.
Spacing measure_spacing(const Cloud& cloud);

}  // namespace relievo
