// Lets one instance of the module draw the frames of another, so that a frame is drawn while the next one is
// solved.
#pragma once

#include "studio/answers.h"
#include "studio/engine.h"
#include "web/calls.h"

namespace relievo::app::web {

// Does the action "picture". If another instance can draw the frame, the facts have `is_undrawn`, and
// the body is the file "frame" for draw(). It has a surface or heights only if they are not those of the last
// such body.
studio::Answer undrawn_frame(studio::Engine& engine, const nlohmann::json& request);

// Draws the last file "frame", in the size, light, material and camera of the request. The surface and the
// heights are those of the last file that had any. Errors: those of picture_request() and read_file().
Result<studio::Answer> draw(const nlohmann::json& request);

}  // namespace relievo::app::web
