#include <algorithm>
#include <cmath>

#include "geometry/compact.h"
#include "plate/tool_samples.h"
#include "relievo/core/image.h"
#include "relievo/core/parallel.h"
#include "relievo/plate/tool.h"

namespace relievo {
namespace {

constexpr double least_reach_tolerance_mm = .01;

// Sums over the samples of a block.
struct Count {
  std::size_t front = 0, reached = 0;
  float largest = 0;
};

Count count_reached(const Image<float>& residual, double tolerance_mm) {
  return parallel_reduce(
      residual.pixels.size(), Count{},
      [&](std::size_t begin, std::size_t end) {
        Count count;
        for (std::size_t i = begin; i < end; ++i) {
          const float left = residual.pixels[i];
          if (left != left) continue;
          ++count.front;
          count.reached += static_cast<double>(left) <= tolerance_mm;
          count.largest = std::max(count.largest, left);
        }
        return count;
      },
      [](const Count& a, const Count& b) {
        return Count{a.front + b.front, a.reached + b.reached, std::max(a.largest, b.largest)};
      });
}

Image<float> difference(const Image<float>& a, const Image<float>& b) {
  Image<float> out = a;
  for (std::size_t i = 0; i < out.pixels.size(); ++i) out.pixels[i] -= b.pixels[i];
  return out;
}

}  // namespace

ToolReach measure_reach(const Solid& solid, const Tool& tool) {
  const Box box = used_box(solid.points, std::span(solid.triangles).first(solid.front_triangles));
  ToolReach reach;
  if (box.is_empty()) return reach;
  HeightField field = front_samples(solid, box, tool);
  reach.mm_per_sample = field.mm_per_pixel;
  reach.tolerance_mm = std::max(least_reach_tolerance_mm, field.mm_per_pixel / 8);
  reach.heights_mm = std::move(field.z);
  reach.residual_mm =
      difference(close_by_tool(reach.heights_mm, reach.mm_per_sample, tool), reach.heights_mm);
  const Count count = count_reached(reach.residual_mm, reach.tolerance_mm);
  reach.largest_residual_mm = static_cast<double>(count.largest);
  if (count.front > 0)
    reach.reached_share = static_cast<double>(count.reached) / static_cast<double>(count.front);
  return reach;
}

}  // namespace relievo
