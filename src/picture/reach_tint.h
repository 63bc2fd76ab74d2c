// Colours the material that a milling tool leaves, in pictures of a body.
#pragma once

#include <memory>

#include "relievo/core/types.h"
#include "relievo/plate/tool.h"

namespace relievo {

class ReachTint {
 public:
  // `front` is the box of the measured front in the body's coordinates. If `reach` is null, nothing is
  // coloured.
  ReachTint(std::shared_ptr<const ToolReach> reach, const Box& front);

  // Returns the linear colour of a point on the front: orange to red if more than the tolerance is left
  // there, otherwise `colour`.
  Vec3f operator()(const Vec3f& colour, const Vec3f& place) const;

 private:
  std::shared_ptr<const ToolReach> reach_;
  Vec2f corner_ = Vec2f::Zero();  // upper left corner of the samples, mm
};

}  // namespace relievo
