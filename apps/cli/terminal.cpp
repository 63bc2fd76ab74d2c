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

std::string on_one_line(std::string_view text) {
  std::string line;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    // U+0080 to U+009F are control characters, too.
    const bool is_second_set =
        byte == 0xC2 && i + 1 < text.size() && static_cast<unsigned char>(text[i + 1]) < 0xA0;
    if (is_second_set) ++i;
    line += byte < 0x20 || byte == 0x7F || is_second_set ? '?' : text[i];
  }
  return line;
}

}  // namespace relievo::app::cli
