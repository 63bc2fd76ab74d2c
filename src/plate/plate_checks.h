// What make_plate() needs to be right.
#pragma once

#include "relievo/plate/solid.h"

namespace relievo {

std::unexpected<Error> plate_error(ErrorKind kind, std::string input, std::string expected);

// Checks lengths and the front, see make_plate().
Result<void> check_plate(const Front& front, const PlateOptions& options);

}  // namespace relievo
