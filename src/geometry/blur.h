// Averages over neighbourhoods of pixels.
#pragma once

#include "relievo/core/image.h"

namespace relievo {

// Replaces each value of an image with one channel by an average of its neighbourhood: two passes of a box of
// 2 radius + 1 pixels in each direction. The border continues outside the image. The time does not depend on
// the radius.
void blur(Image<float>& image, int radius);

}  // namespace relievo
