// Finds the points of a model under places of its picture. Tested by apps/studio/tests/server.test.mjs.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "relievo/scan/surface.h"

namespace relievo::app::studio {

constexpr std::size_t most_places = 1000;  // of one request

// Returns the model's point under each place, in the coordinates of the scan; nothing beside the model. A place has the
// shares of the width and height of the model's box in the view, from its lower left corner.
std::vector<std::optional<Vec3>> points_under(const Surface& surface, std::span<const Vec2> places);

}  // namespace relievo::app::studio
