// Draws the soft shadow of a body on the ground behind it.
#pragma once

#include "relievo/core/image.h"
#include "relievo/core/types.h"

namespace relievo {

// Adds the shadow of the opaque pixels to the other pixels of a picture with 4 channels, as black of some
// opacity. `to_lamp` is the direction towards the lamp in the picture, y upwards, with length 1.
void add_drop_shadow(Image8& picture, const Vec3f& to_lamp);

}  // namespace relievo
