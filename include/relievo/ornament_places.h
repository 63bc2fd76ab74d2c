// Finds the places of ornaments on a plate, for programs that show ornaments before the solid is made.
#pragma once

#include <optional>
#include <vector>

#include "relievo/core/error.h"
#include "relievo/options.h"

namespace relievo {

struct Surface;

// The place of an ornament: its outlines in mm from the middle of the plate, x to the right and y up. The
// ornament covers the points whose winding number is not 0. If the ornament cannot be made, only `error` is
// set.
struct OrnamentPlace {
  std::vector<std::vector<Vec2>> outlines = {};
  std::optional<Vec2> at_mm =
      {};  // for a straight text or a drawing: the value of Ornament::at_mm that puts it there
  std::optional<Error> error = {};
};

// Returns the places of options.all_ornaments(), in that order, on the flat plate of the surface's relief.
// Only make_relief() checks that the ornaments have room. Errors: those of check() and with_width().
Result<std::vector<OrnamentPlace>> ornament_places(const Surface& surface, const ReliefOptions& options);

}  // namespace relievo
