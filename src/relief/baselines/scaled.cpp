#include "relief/baselines/scaled.h"

#include <algorithm>
#include <limits>

#include "relief/height_span.h"

namespace relievo {

Relief scaled_relief(std::vector<double> heights, const Surface& surface, double height) {
  for (std::size_t i = 0; i < heights.size(); ++i)
    if (surface.boundary.is_boundary[i]) heights[i] = 0;
  const double span = height_span(heights);
  if (!(span > 0)) return {std::move(heights), 0, {}};
  for (double& z : heights) z *= height / span;
  return {std::move(heights), height, {}};
}

std::vector<double> depths(const Surface& surface) {
  double deepest = std::numeric_limits<double>::infinity();
  for (const Vec3& p : surface.points) deepest = std::min(deepest, p.z());
  std::vector<double> z;
  z.reserve(surface.points.size());
  for (const Vec3& p : surface.points) z.push_back(p.z() - deepest);
  return z;
}

}  // namespace relievo
