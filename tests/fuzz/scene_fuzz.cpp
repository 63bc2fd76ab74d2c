// Fuzz target of the scene reader.
#include <cstdlib>

#include "common/scene_file.h"
#include "fuzz/fuzz_program.h"

void run_target(std::string_view input) {
  using namespace relievo;
  const auto entries = app::read_scene_file(input, "scene.json");
  if (!entries) {
    if (entries.error().input != "scene.json" || entries.error().expected.empty()) std::abort();
    return;
  }
  if (entries->empty()) std::abort();
  for (const app::SceneEntry& entry : *entries)
    if (entry.path.empty() || !entry.pose.rotate_deg.allFinite() || !(entry.pose.scale > 0)) std::abort();
}
