// Fuzz target of the scene reader.
#include <cstdlib>

#include "common/scene_file.h"
#include "fuzz/fuzz_program.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace relievo;
  const auto entries = app::read_scene_file({reinterpret_cast<const char*>(data), size}, "scene.json");
  if (!entries) {
    if (entries.error().input != "scene.json" || entries.error().expected.empty()) std::abort();
    return 0;
  }
  if (entries->empty()) std::abort();
  for (const app::SceneEntry& entry : *entries)
    if (entry.path.empty() || !entry.pose.rotate_deg.allFinite() || !(entry.pose.scale > 0)) std::abort();
  return 0;
}

RELIEVO_RUN_FILES
