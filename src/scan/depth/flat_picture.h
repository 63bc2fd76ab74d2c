// Recognises the surfaces that picture_cloud() makes.
#pragma once

#include <algorithm>

#include "relievo/scan/surface.h"

namespace relievo {

// Returns true if all points are at the same height and have colours, as the pixels of a picture.
inline bool is_flat_picture(const Surface& surface) {
  const auto is_level = [&](const Vec3& p) { return p.z() == surface.points.front().z(); };
  return !surface.colours.empty() && std::ranges::all_of(surface.points, is_level);
}

}  // namespace relievo
