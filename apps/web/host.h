// Declares what the program needs of the JavaScript that runs it, besides WASI's files and clock.
#pragma once

#include "relievo/core/progress.h"

namespace relievo::app::web {

// Returns a progress that the host hears of. It is cancelled when the host says so at the beginning of a stage.
class HostProgress : public Progress {
 public:
  HostProgress();
};

}  // namespace relievo::app::web
