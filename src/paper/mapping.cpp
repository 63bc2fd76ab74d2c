#include "paper/mapping.h"

#include <cmath>

#include "core/memory.h"
#include "relievo/core/parallel.h"

namespace relievo::paper {
namespace {

// Returns the options for six lattices. The coarsest one has one cell along the longer side.
SplineOptions lattices(std::span<const Vec2> points) {
  constexpr int levels = 6;
  const Box box = Box::of(points);
  return {box.min.head<2>(), box.max.head<2>(), box.longer_side() / (1 << (levels - 1)), levels};
}

float largest(std::span<const float> heights) {
  float most = 0;
  for (const float z : heights) most = std::max(most, std::abs(z));
  return most;
}

}  // namespace

HeightMapping::HeightMapping(std::span<const Vec2> control, std::span<const Vec2> visible,
                             Uncompressed uncompressed)
    : uncompressed_(std::move(uncompressed)),
      faint_(faint_share * largest(uncompressed_.control)),
      spline_(control, std::vector<float>(control.size(), 1), lattices(visible)),
      places_(spline_.pack(visible)) {}

std::size_t HeightMapping::memory() const {
  return bytes(uncompressed_.control) + bytes(uncompressed_.visible) + spline_.memory() + bytes(places_);
}

HeightMapping::Workspace HeightMapping::make_workspace() const {
  return {std::vector<float>(uncompressed_.control.size()), spline_.make_function(),
          spline_.make_workspace()};
}

void HeightMapping::carry(std::span<const float> control_heights, Workspace& workspace,
                          std::span<float> heights) const {
  for (std::size_t i = 0; i < control_heights.size(); ++i)
    workspace.ratio[i] = compression_ratio(control_heights[i], uncompressed_.control[i], faint_);
  spline_.fit(workspace.ratio, workspace.function, workspace.fit);
  spline_.evaluate(workspace.function, places_, heights);
  parallel_for(heights.size(), [&](std::size_t i) { heights[i] *= uncompressed_.visible[i]; });
}

}  // namespace relievo::paper
