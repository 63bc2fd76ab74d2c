// Validates the arguments of make_plate().
// Tested by solid_test and plate_rim_test.
#pragma once

#include "relievo/plate/solid.h"

namespace relievo {

// Returns an error about an argument of make_plate() or wrap_plate().
std::unexpected<Error> plate_error(ErrorKind kind, std::string input, std::string expected);

// Checks lengths and the front. Errors: those of make_plate().
Result<void> check_plate(const HeightFieldMesh& front, const PlateOptions& options);

}  // namespace relievo
