// What is made of a relief besides the relief itself: its mirror image, the die that strikes it, a
// lithophane.
#pragma once

#include <string_view>

#include "relievo/plate/solid.h"
#include "relievo/scan/surface.h"

namespace relievo {

enum class Form {
  relief,
  mirror,     // left and right swapped, as for a stamp
  die,        // the hollow that strikes or casts the relief: high is deep, left and right swapped
  lithophane  // held before a light it shows the model: thick where the model is dark
};

// Returns the form of that name. Errors: kind option for any other name.
Result<Form> parse_form(std::string_view name);

// Returns the front with left and right swapped.
Front mirrored(Front front);

// Returns the front of the die: mirrored, and every height negative.
Front as_die(Front front);

// Returns a front over the surface, which is `mm_per_unit` as large, with heights from 0, where the model is
// brightest, to `height_mm`. Light passes as exp(-thickness), so heights are minus the logarithm of the
// brightness: that of a white model under a lamp from the upper left, times the brightness of its colours
// where it has them. The ground and the outline are dark, and the least that is told from dark is a tenth of
// the brightest.
Front lithophane(const Surface& surface, double mm_per_unit, double height_mm);

}  // namespace relievo
