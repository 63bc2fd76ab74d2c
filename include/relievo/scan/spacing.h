// Sampling distance (stage 1): how far apart the points are, everywhere and on the whole.
#pragma once

#include <vector>

#include "relievo/scan/cloud.h"

namespace relievo {

inline constexpr std::size_t spacing_neighbours = 8;

struct Spacing {
  // rho: the median over all points, in the cloud's units; 0 if fewer than 2 points or most are equal.
  double rho = 0;
  // Per point sqrt(pi r^2 / k), r the distance to the k-th nearest other point: the side of the square that a
  // point has to itself. Not the nearest distance, which is half of that where points are scattered at
  // random.
  std::vector<float> local;
  // Per point the numbers of its k nearest other points, nearest first; no_index where the cloud has fewer.
  std::vector<std::array<Index, spacing_neighbours>> nearest;
};

// Returns the spacing of a cloud. The order of the points does not matter to rho and local.
Spacing measure_spacing(const Cloud& cloud);

}  // namespace relievo
