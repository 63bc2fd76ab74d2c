// Progress of a long call: stage names, fraction, timing and cancellation in one small object.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "relievo/core/error.h"

namespace relievo {

struct StageTime {
  std::string name;
  double seconds = 0;
};

// Passed as the last argument of long calls; a null pointer means "nobody watches".
// Threads: stage() and times() belong to the thread that runs the call; cancel() and is_cancelled() may be
// called from any thread at any time.
class Progress {
 public:
  // Called at the start of each stage with its name and the fraction done so far, in [0, 1], never
  // decreasing.
  using Watcher = std::function<void(std::string_view stage, double fraction)>;

  Progress() = default;
  explicit Progress(Watcher watcher) : watcher_(std::move(watcher)) {}

  // Ends the running stage, records its time, and starts the next. Returns an error of kind `cancelled` if
  // cancel() was called, in which case the caller returns it at once.
  Result<void> stage(std::string_view name, double fraction);

  // Ends the last stage and records its time; fraction becomes 1.
  void finish();

  void cancel() { is_cancelled_ = true; }
  bool is_cancelled() const { return is_cancelled_; }

  // Stages that have ended, in order.
  const std::vector<StageTime>& times() const { return times_; }

 private:
  using Clock = std::chrono::steady_clock;
  void end_stage();

  Watcher watcher_;
  std::atomic<bool> is_cancelled_ = false;
  std::vector<StageTime> times_;
  std::string running_;
  Clock::time_point started_;
  double fraction_ = 0;
};

// The same for a pointer that may be null: no-op then.
inline Result<void> begin_stage(Progress* progress, std::string_view name, double fraction) {
  return progress ? progress->stage(name, fraction) : Result<void>{};
}

}  // namespace relievo
