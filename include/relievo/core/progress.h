// Reports the progress of a long call: stage names, fraction done, times and cancellation.
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

// Long calls take a pointer to a Progress as their last argument. A call with a null pointer reports nothing
// and cannot be cancelled. Only the thread of the call may use stage() and times(); any thread may use
// cancel() and is_cancelled() at any time.
class Progress {
 public:
  // A function that is called at the start of each stage, with the stage's name and the fraction of the call
  // that is done. The fraction is in [0, 1] and never decreases.
  using Watcher = std::function<void(std::string_view stage, double fraction)>;

  Progress() = default;
  explicit Progress(Watcher watcher) : watcher_(std::move(watcher)) {}

  // Ends the current stage, records its time, and starts the next one. Returns an error of kind `cancelled`
  // if cancel() was called; the caller must then return that error.
  Result<void> stage(std::string_view name, double fraction);

  // Ends the last stage, records its time and sets the fraction to 1.
  void finish();

  void cancel() { is_cancelled_ = true; }
  bool is_cancelled() const { return is_cancelled_; }

  // Returns the finished stages, in order.
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

// Returns an error of kind `cancelled` if cancel() was called. Long stages call this repeatedly. The pointer
// may be null.
Result<void> check_cancelled(const Progress* progress);

// Calls stage(). Does nothing if the pointer is null.
inline Result<void> begin_stage(Progress* progress, std::string_view name, double fraction) {
  return progress ? progress->stage(name, fraction) : Result<void>{};
}

}  // namespace relievo
