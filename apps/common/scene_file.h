// Reads scene files: several models and their poses, in JSON.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "relievo/scene.h"

namespace relievo::app {

struct SceneEntry {
  std::string path;  // path from the working directory
  Pose pose = {};
};

// Returns the models of a scene file. Error messages call it `name`. Relative paths start at the file's own
// folder:
//   {"models": [{"file": "a.ply", "rotate": [0, 60, 0], "translate": [1, 0, 0], "scale": 2, "mirror": true}]}
// All keys except `file` are optional. Errors: kind input for a text that is not JSON, unknown keys, values
// of another type or size, and missing files. They name the key: "models[1].rotate".
Result<std::vector<SceneEntry>> read_scene_file(std::string_view text, const std::string& name);

}  // namespace relievo::app
