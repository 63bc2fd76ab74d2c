// Normals as the pipeline needs them, whatever the file has.
#pragma once

#include "relievo/scan/cloud.h"
#include "relievo/scan/spacing.h"

namespace relievo {

enum class NormalsWere { outward, missing, inward };

// Gives a cloud in view coordinates outward normals: estimates them where there are none, turns them where
// most point inwards. `cloud` is the same in its own frame. Returns what they were.
NormalsWere settle_normals(Cloud& viewed, const Spacing& spacing, const Cloud& cloud);

}  // namespace relievo
