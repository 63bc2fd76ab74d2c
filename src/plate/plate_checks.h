// Validates the arguments of make_plate(). Tested by solid_test and plate_rim_test.
#pragma once

#include "relievo/plate/solid.h"

namespace relievo {

// Checks lengths and the front. Errors: those of make_plate().
Result<void> check_plate(const HeightFieldMesh& front, const PlateOptions& options);

}  // namespace relievo
