// Finds the points of a model under positions in its picture. Tested by apps/studio/tests/server.test.mjs.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "relievo/scan/surface.h"

namespace relievo::app::studio {

constexpr std::size_t most_places = 1000;  // largest number of positions in one request

// Returns the model's point under each position, in the coordinates of the scan; nothing for positions beside the
// model. A position is given as shares of the width and height of the model's box in the view, from the lower left
// corner of the box.
std::vector<std::optional<Vec3>> points_under(const Surface& surface, std::span<const Vec2> places);

}  // namespace relievo::app::studio
