// Recognises surfaces made by picture_cloud().
#pragma once

#include <algorithm>

#include "relievo/scan/surface.h"

namespace relievo {

// Returns whether all points have the same height and a colour, as the pixels of a picture do.
inline bool is_flat_picture(const Surface& surface) {
  const auto is_level = [&](const Vec3& p) { return p.z() == surface.points.front().z(); };
  return !surface.colours.empty() && std::ranges::all_of(surface.points, is_level);
}

}  // namespace relievo
