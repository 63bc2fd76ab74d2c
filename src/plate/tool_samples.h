// How finely the front is sampled to find what a tool reaches.
#pragma once

#include <algorithm>
#include <cmath>

#include "relievo/plate/tool.h"

namespace relievo {

// Returns the number of samples along the longer side: a twelfth of the tool's radius apart, in [2048, 4096].
inline int samples_for(const Tool& tool, double longer_mm) {
  constexpr int least_samples = 2048, most_samples = 4096;
  constexpr double samples_per_radius = 12;
  const double radius = (tool.kind == Tool::Kind::v ? tool.tip_mm : tool.diameter_mm) / 2;
  if (!(radius > 0)) return least_samples;
  const double wanted = longer_mm / radius * samples_per_radius;
  return static_cast<int>(std::clamp<double>(std::ceil(wanted), least_samples, most_samples));
}

}  // namespace relievo
