// Shows what became of the pixels of a depth image.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "relievo/picture/render.h"
#include "relievo/scene.h"

namespace relievo::app::studio {

// Returns a picture of a depth image, with a pixel for each of PixelUses::uses: kept pixels are grey, nearer
// ones brighter, and the others have the colour of their use. The model has pixels.
Picture picture_of_uses(const SceneModel& image);

// Returns the meaning of the image's values, whether they became a surface or the brightness of a lithophane,
// whether they are proportional to heights, the width of the image over its height, the number of pixels, and for each use but `kept` its name, its
// colour and the number of its pixels. The model has pixels.
nlohmann::json uses_json(const SceneModel& image);

}  // namespace relievo::app::studio
