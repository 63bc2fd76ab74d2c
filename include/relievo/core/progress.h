// Progress of a long call: stage names, fraction done, timing and cancellation in one small object.
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

// Long calls take a pointer to a Progress as their last argument; a null pointer means that nothing is
// reported or cancelled. stage() and times() may only be called by the thread that runs the call; cancel()
// and is_cancelled() by any thread at any time.
class Progress {
 public:
  // Called at the start of each stage with its name and the fraction done so far, in [0, 1], never
  // decreasing.
  using Watcher = std::function<void(std::string_view stage, double fraction)>;

  Progress() = default;
  explicit Progress(Watcher watcher) : watcher_(std::move(watcher)) {}

  // Ends the running stage, records its time, and starts the next one. Returns an error of kind `cancelled`
  // if cancel() was called; the caller then returns that error at once.
  Result<void> stage(std::string_view name, double fraction);

  // Ends the last stage, records its time and sets the fraction to 1.
  void finish();

  void cancel() { is_cancelled_ = true; }
  bool is_cancelled() const { return is_cancelled_; }

  // Returns the stages that have ended, in order.
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

// Returns an error of kind `cancelled` if cancel() was called. Long stages call it repeatedly. The pointer
// may be null.
Result<void> check_cancelled(const Progress* progress);

// Calls stage(); does nothing if the pointer is null.
inline Result<void> begin_stage(Progress* progress, std::string_view name, double fraction) {
  return progress ? progress->stage(name, fraction) : Result<void>{};
}

}  // namespace relievo
