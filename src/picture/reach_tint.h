// Colours, in pictures of a body, the material that a milling tool leaves. Tested by
// tests/picture/reach_tint_test.cpp.
#pragma once

#include <memory>

#include "relievo/core/types.h"
#include "relievo/plate/tool.h"

namespace relievo {

class ReachTint {
 public:
  // Colours nothing if `reach` is null. `front` is the measured front's box, in the body's coordinates.
  ReachTint(std::shared_ptr<const ToolReach> reach, const Box& front);

  // Returns the linear colour of a point on the front: orange to red where more than the tolerance is left,
  // else `colour`.
  Vec3f operator()(const Vec3f& colour, const Vec3f& place) const;

 private:
  std::shared_ptr<const ToolReach> reach_;
  Vec2f corner_ = Vec2f::Zero();  // upper left corner of the samples, mm
};

}  // namespace relievo
