#include "cli/batch_progress.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "cli/terminal.h"
#include "relievo/core/text.h"

namespace relievo::app::cli {

BatchProgress::BatchProgress(std::size_t jobs, bool is_quiet)
    : jobs_(jobs), is_quiet_(is_quiet), is_terminal_(::isatty(STDERR_FILENO) != 0) {}

BatchProgress::~BatchProgress() {
  if (is_terminal_ && !is_quiet_) std::fputs("\r\x1b[K", stderr);
}

void BatchProgress::show(const batch::JobResult& result, std::size_t done) {
  if (result.is_kept) ++kept_;
  if (!result.record.is_made) ++failed_;
  const char* const clear = is_terminal_ ? "\r\x1b[K" : "";
  if (!result.record.is_made && !result.is_kept && !is_quiet_)
    std::fprintf(stderr, "%sfailed: %s: %s\n", clear, on_one_line(result.record.name).c_str(),
                 on_one_line(result.record.error).c_str());
  if (is_quiet_) return;
  const std::size_t twentieth = std::max<std::size_t>(1, jobs_ / 20);
  if (is_terminal_)
    std::fprintf(stderr, "\r\x1b[K%s", line(done).c_str());
  else if (done % twentieth == 0 || done == jobs_)
    std::fprintf(stderr, "%s\n", line(done).c_str());
  std::fflush(stderr);
}

std::string BatchProgress::line(std::size_t done) const {
  std::string text = cat(done, " of ", jobs_);
  if (kept_ > 0) text += cat(", ", kept_, " done before");
  if (failed_ > 0) text += cat(", ", failed_, " failed");
  text += time_left(done);
  if (!is_terminal_) return text;
  constexpr std::size_t width = 30;
  std::string bar(width, '-');
  const std::size_t filled = width * done / std::max<std::size_t>(1, jobs_);
  bar.replace(0, filled, filled, '#');
  return cat("[", bar, "] ", text);
}

// Jobs that an earlier run completed take no time now, so the estimate does not count them.
std::string BatchProgress::time_left(std::size_t done) const {
  const std::size_t made = done - std::min(done, kept_);
  if (made == 0 || done == jobs_) return {};
  const std::chrono::duration<double> so_far = std::chrono::steady_clock::now() - started_;
  const double seconds = so_far.count() / static_cast<double>(made) * static_cast<double>(jobs_ - done);
  if (seconds < 90) return cat(", ", std::ceil(seconds), " s left");
  if (seconds < 5400) return cat(", ", std::ceil(seconds / 60), " min left");
  return cat(", ", std::ceil(seconds / 360) / 10, " h left");
}

}  // namespace relievo::app::cli
