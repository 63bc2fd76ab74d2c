// What a wrap asks of the plate that is bent around it. Tested by tests/plate/wrap_test.cpp.
#pragma once

#include "relievo/plate/solid.h"

namespace relievo {

// Returns an error of kind option if a plate with this bottom below the ground and this highest point above it would
// reach the wrap's axis.
Result<void> check_room(const Wrap& wrap, double bottom_mm, double highest_mm);

// Returns an error of kind option if the plate goes all the way around, but has no two straight and equal sides that
// can meet.
Result<void> check_closed(const PlateOptions& options, const Wrap& wrap);

}  // namespace relievo
