#include "web/host.h"

#include <cstddef>

// Imported from the module "relievo". Returns 1 to cancel.
__attribute__((import_module("relievo"), import_name("progress"))) extern "C" int relievo_host_progress(
    const char* stage, std::size_t size, double fraction);

namespace relievo::app::web {

HostProgress::HostProgress()
    : Progress([this](std::string_view stage, double fraction) {
        if (relievo_host_progress(stage.data(), stage.size(), fraction) != 0) cancel();
      }) {}

}  // namespace relievo::app::web
