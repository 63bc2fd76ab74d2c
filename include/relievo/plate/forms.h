// Makes the forms of a relief: as it is, mirrored, as a die that strikes it, or as a lithophane.
#pragma once

#include <array>
#include <string_view>

#include "relievo/core/choice.h"
#include "relievo/core/error.h"

namespace relievo {

struct HeightFieldMesh;
struct Surface;

enum class Form {
  relief,
  mirror,     // left and right swapped, as for a stamp
  die,        // strikes or casts the relief: deep where the relief is high, left and right swapped
  lithophane  // shows the model with a light behind it: thick where the model is dark
};

inline constexpr std::array<Choice<Form>, 4> form_choices{{{"relief", Form::relief},
                                                           {"mirror", Form::mirror},
                                                           {"die", Form::die},
                                                           {"lithophane", Form::lithophane}}};

// Returns the front with left and right swapped.
HeightFieldMesh mirrored(HeightFieldMesh front);

// Returns the front of the die: mirrored, with every height multiplied by -1.
HeightFieldMesh as_die(HeightFieldMesh front);

// Returns a lithophane of the surface, scaled by `mm_per_unit`. Its heights are 0 where the model is
// brightest, and at most `height_mm`. A plate transmits light as exp(-thickness), so a height is minus the
// logarithm of the brightness. The brightness is that of a white model under a lamp from the upper left,
// multiplied by the luminance of the model's colours, if any. The brightest 2 % of the points (highlights)
// count as equally bright. The ground, the outline, and the darkest points have the largest height. The
// darkest points are all points below a tenth of the highlights' brightness. But if more than a tenth of the
// points are that dark, only the darkest tenth have the largest height.
//
// A flat surface with colours is a picture. Its heights fall linearly from black to white, without highlights
// and shading. The values of a picture already rise more slowly than its brightness, because displays raise
// the values to the power of about 2.2, so no logarithm is taken. Linear heights also keep dark pixels
// distinguishable.
HeightFieldMesh lithophane(const Surface& surface, double mm_per_unit, double height_mm);

}  // namespace relievo
