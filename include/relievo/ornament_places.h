// Finds the places of ornaments on a plate, for programs that show ornaments before the solid is made.
#pragma once

#include <optional>
#include <vector>

#include "relievo/core/error.h"
#include "relievo/options.h"

namespace relievo {

struct Surface;

// The place of an ornament: its outlines in mm from the middle of the plate, x to the right and y up, filled by winding
// number. An ornament that cannot be set has an error instead.
struct OrnamentPlace {
  std::vector<std::vector<Vec2>> outlines = {};
  std::optional<Vec2> at_mm =
      {};  // the place of a straight text or a drawing that Ornament::at_mm would give
  std::optional<Error> error = {};
};

// Returns the places of options.all_ornaments(), in that order, on the flat plate of the surface's relief. Whether the
// ornaments have room is left to make_relief(). Errors: those of check() and with_width().
Result<std::vector<OrnamentPlace>> ornament_places(const Surface& surface, const ReliefOptions& options);

}  // namespace relievo
