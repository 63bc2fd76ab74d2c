// Lets one instance of the module draw the frames of another, so that a frame is drawn while the next one is
// solved.
#pragma once

#include "studio/answers.h"
#include "studio/engine.h"
#include "web/calls.h"

namespace relievo::app::web {

// Performs the action "picture". If another instance can draw the frame, the facts have `is_undrawn`, and the body is
// the file "frame" for draw(). This file contains the surface and the heights only if they differ from those in the
// last such file.
studio::Answer undrawn_frame(studio::Engine& engine, const nlohmann::json& request);

// Draws the frame in the last file "frame", with the size, light, material and camera of the request. A surface or
// heights that the file lacks are taken from an earlier file. Errors: those of picture_request() and read_file().
Result<studio::Answer> draw(const nlohmann::json& request);

}  // namespace relievo::app::web
