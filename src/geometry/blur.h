// Averages over neighbourhoods of pixels.
#pragma once

#include "relievo/core/image.h"

namespace relievo {

// Replaces each value of an image with one channel by an average of its neighbourhood, twice a box of
// 2 radius + 1 pixels in each direction; the border continues outside the image. Time does not depend on the
// radius.
void blur(Image<float>& image, int radius);

}  // namespace relievo
