// Places ornaments on a plate.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "geometry/raised_shape.h"
#include "relievo/lettering/ornament.h"

namespace relievo {

// The area for ornaments: the ground of a plate, and the limits of the ornaments' walls.
struct OrnamentFrame {
  std::vector<Vec2> inner;            // convex polygon inside the rim, counter-clockwise, in mm
  double margin_mm = 5;               // width of the ground around the relief
  double border_mm = 0;               // width of the part of the margin where borders leave no room for texts
  std::optional<double> rim_mm = {};  // height of the rim; empty without a rim
  double slope = 4;                   // steepest slope of walls, > 0
  bool is_mirrored = false;           // whether left and right are exchanged
  bool is_die = false;                // whether raised ornaments become sunk
};

// Returns the width of the margin that borders occupy, in mm. Ignores borders that are farther inside than
// the margin's middle.
double margin_of_borders(std::span<const Ornament> ornaments, double margin_mm);

// Returns the shapes of the ornaments in the order of the list. Errors: those of check_text(); kind option
// for lengths out of their range, for texts longer than their circle, and for drawings without an area or a
// size.
Result<std::vector<RaisedShape>> ornament_shapes(std::span<const Ornament> ornaments,
                                                 const OrnamentFrame& frame);

}  // namespace relievo
