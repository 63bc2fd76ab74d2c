// Colours the material that a milling tool leaves, in pictures of a body.
#pragma once

#include <memory>

#include "relievo/core/types.h"
#include "relievo/plate/tool.h"

namespace relievo {

class ReachTint {
 public:
  // `front` is the box of the measured front in the body's coordinates. If `reach` is null, colours do not change.
  ReachTint(std::shared_ptr<const ToolReach> reach, const Box& front);

  // Returns the linear colour of a point on the front, given its colour without tint. If more material
  // than the tolerance is left at the point, the result is orange to red.
  Vec3f operator()(const Vec3f& colour, const Vec3f& place) const;

 private:
  std::shared_ptr<const ToolReach> reach_;
  Vec2f corner_ = Vec2f::Zero();  // upper left corner of the samples, mm
};

}  // namespace relievo
