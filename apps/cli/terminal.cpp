#include "cli/terminal.h"

#include <unistd.h>

#include <cstdio>

#include "common/stage_names.h"

namespace relievo::app::cli {

Progress::Watcher progress_bar(bool is_quiet) {
  if (is_quiet || !::isatty(STDERR_FILENO)) return {};
  return [](std::string_view stage, double fraction) {
    constexpr int width = 30;
    if (fraction >= 1) {
      std::fputs("\r\x1b[K", stderr);
      return;
    }
    const int filled = static_cast<int>(fraction * width);
    std::string bar(static_cast<std::size_t>(width), '-');
    bar.replace(0, static_cast<std::size_t>(filled), static_cast<std::size_t>(filled), '#');
    const std::string name(name_of_stage(stage));
    std::fprintf(stderr, "\r\x1b[K[%s] %3.0f %%  %s", bar.c_str(), fraction * 100, name.c_str());
    std::fflush(stderr);
  };
}

}  // namespace relievo::app::cli
