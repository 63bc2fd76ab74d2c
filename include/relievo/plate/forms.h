// The forms in which a relief can be made: as it is, as its mirror image, as the die that strikes it, or as a
// lithophane.
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
  lithophane  // shows the model in front of a light: thick where the model is dark
};

inline constexpr std::array<Choice<Form>, 4> form_choices{{{"relief", Form::relief},
                                                           {"mirror", Form::mirror},
                                                           {"die", Form::die},
                                                           {"lithophane", Form::lithophane}}};

// Returns the front with left and right swapped.
HeightFieldMesh mirrored(HeightFieldMesh front);

// Returns the front of the die: mirrored, with every height multiplied by -1.
HeightFieldMesh as_die(HeightFieldMesh front);

// Returns a lithophane of the surface, scaled by `mm_per_unit`, with heights from 0, where the model is
// brightest, to `height_mm`. A plate transmits light as exp(-thickness), so a height is minus the logarithm
// of the brightness. The brightness is that of a white model under a lamp from the upper left, times the
// luminance of the model's colours if it has any. Highlights, the brightest 2 % of the points, count as
// equally bright. The greatest height belongs to the ground, to the outline, and to points less than a tenth
// as bright as the highlights. If the darkest tenth of the points is darker still, it belongs to that tenth
// instead.
//
// A flat surface with colours is a picture: its heights fall linearly from black to white, without highlights
// and shading. Displays show the values of a picture raised to about 2.2, so that linear values are close to
// the logarithm of the brightness, and dark pixels still differ.
HeightFieldMesh lithophane(const Surface& surface, double mm_per_unit, double height_mm);

}  // namespace relievo
