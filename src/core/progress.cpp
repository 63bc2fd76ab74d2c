#include "relievo/core/progress.h"

#include <algorithm>

#include "relievo/core/text.h"
#include "relievo/core/within_memory.h"

namespace relievo {
namespace {

std::string words_of(const MemoryNeed& need) {
  std::string words = "expected more free memory";
  if (need.points > 0) append(words, cat(" for ", need.points, " points"));
  if (need.resolution_mm > 0) append(words, cat(" at a resolution of ", need.resolution_mm, " mm"));
  return words += ", found none left";
}

}  // namespace

Error memory_error(const MemoryNeed& need) noexcept {
  Error error{ErrorKind::memory, {}, {}, {}};
  try {
    error.expected = words_of(need);
  } catch (const std::bad_alloc&) {
    error.expected = "expected memory";  // this text is short enough to need no allocation
  }
  return error;
}

void Progress::end_stage() {
  if (running_.empty()) return;
  const std::chrono::duration<double> spent = Clock::now() - started_;
  times_.push_back({running_, spent.count()});
  running_.clear();
}

Result<void> Progress::stage(std::string_view name, double fraction) {
  end_stage();
  RELIEVO_CHECK(check_cancelled(this));
  running_ = name;
  started_ = Clock::now();
  // If a stage is shorter than expected, the fraction must not decrease.
  fraction_ = std::clamp(fraction, fraction_, 1.0);
  if (watcher_) watcher_(name, fraction_);
  return {};
}

void Progress::finish() {
  end_stage();
  fraction_ = 1;
  if (watcher_) watcher_("done", 1);
}

Result<void> check_cancelled(const Progress* progress) {
  if (!progress || !progress->is_cancelled()) return {};
  return cancelled_error();
}

}  // namespace relievo
