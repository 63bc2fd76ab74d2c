// Averages over neighbourhoods of pixels.
#pragma once

#include <vector>

namespace relievo {

// Replaces each of the width x height values by an average of its neighbourhood, twice a box of 2 radius + 1
// pixels in each direction; the border continues outside the picture. Time does not depend on the radius.
void blur(std::vector<float>& values, int width, int radius);

}  // namespace relievo
