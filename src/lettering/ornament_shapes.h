// Places ornaments on a plate. Tested by tests/lettering/ornament_shapes_test.cpp.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "geometry/raised_shape.h"
#include "relievo/lettering/ornament.h"

namespace relievo {

// The place for ornaments: the ground of a plate, and the limits of their walls.
struct OrnamentFrame {
  std::vector<Vec2> inner;            // convex polygon inside the rim, counter-clockwise, mm
  double margin_mm = 5;               // width of the ground around the relief
  double border_mm = 0;               // of the margin, which borders at the rim take from the texts
  std::optional<double> rim_mm = {};  // height of the rim, if there is one
  double slope = 4;                   // of walls, > 0
  bool is_mirrored = false;           // left and right swapped
  bool is_die = false;                // raised becomes sunk
};

// Returns the shapes of the ornaments in the order of the list. Texts without a size or an inset keep clear of the
// borders of the list, whatever the frame's border_mm is. Errors: those of check_text(); kind option for lengths
// out of their range, for texts longer than their circle, and for drawings without an area or a size.
Result<std::vector<RaisedShape>> ornament_shapes(std::span<const Ornament> ornaments, OrnamentFrame frame);

}  // namespace relievo
