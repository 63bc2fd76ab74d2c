// Checks whether a plate can be bent around its wrap. Tested by tests/plate/wrap_test.cpp.
#pragma once

#include "relievo/plate/solid.h"

namespace relievo {

// Returns an error of kind option if a plate would reach the wrap's axis. The plate's bottom lies `bottom_mm`
// below the ground, and its highest point lies `highest_mm` above the ground.
Result<void> check_room(const Wrap& wrap, double bottom_mm, double highest_mm);

// Returns an error of kind option if the plate goes all the way around, but has no two straight and equal sides that
// can meet.
Result<void> check_closed(const PlateOptions& options, const Wrap& wrap);

}  // namespace relievo
