// Draws how the pixels of a depth image were used.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "relievo/picture/render.h"
#include "relievo/scene.h"

namespace relievo::app::studio {

// Returns a picture of a depth image, with one pixel for each of PixelUses::uses. Kept pixels are grey, and
// the nearer they are the brighter they are. All other pixels have the colour of their use. The model must
// have pixels.
Picture picture_of_uses(const SceneModel& image);

// Returns facts about a depth image: the meaning of its values; whether the values became a surface or the
// brightness of a lithophane; whether the values are proportional to heights; the width of the image divided
// by its height; the number of pixels; and, for each use of pixels except `kept`, the use's name, its colour
// and the number of its pixels. The model must have pixels.
nlohmann::json uses_json(const SceneModel& image);

}  // namespace relievo::app::studio
