// Fuzz target of the scene reader. With clang and -DRELIEVO_FUZZ=ON a libFuzzer program; otherwise it runs
// over the files named on its command line.
#include <cstdlib>
#include <string_view>

#include "common/scene_file.h"

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

#ifndef RELIEVO_LIBFUZZER
#include "run_files.h"

int main(int argc, char** argv) {
  return run_files(argc, argv, [](const std::string& text) {
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  });
}
#endif
