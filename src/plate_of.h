// The plate that the options of a relief ask for.
#pragma once

#include "relievo/options.h"
#include "relievo/plate/forms.h"
#include "relievo/plate/solid.h"
#include "relievo/simplify.h"

namespace relievo {

// Are left and right swapped in this form?
bool is_mirrored(Form form);

// Returns the plate of a relief as high as that. The options have passed check().
PlateOptions plate_of(const ReliefOptions& options, Form form, double relief_mm);

// Returns how wide the bevel of a rim that high must be to lean by that angle off the vertical.
double least_bevel(double height_mm, double draft_deg);

// How simple the front may become, with a tolerance; a curved base takes its share of that.
SimplifyOptions simplest_front(const ReliefOptions& options);

}  // namespace relievo
