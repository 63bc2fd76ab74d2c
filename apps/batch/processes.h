// Runs each job in its own process. If that process crashes, or if the system kills it for lack of memory,
// only that job fails. Tested by tests/cli/batch_test.cpp.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <map>

#include "batch/perform.h"

namespace relievo::app::batch {

// The processes of the running jobs. They are forks of the calling process, and load no other program. So a
// job starts faster than a shell command. They end when the calling process ends or crashes. The calling
// process must not have started a thread, and must have no other child processes.
class Processes {
 public:
  explicit Processes(const RunSettings& settings) : settings_(settings) {}

  // Starts the job, which may use `threads` threads. Errors: kind output if the system allows no more
  // processes.
  Result<void> start(const PlannedJob& planned, int threads);

  // Waits until a job ends for any reason, and returns its outcome. At least one job must be running.
  JobResult wait();

  std::size_t running() const { return running_.size(); }
  double running_mb() const;  // sum of the estimated memory of the running jobs

 private:
  struct Running {
    const PlannedJob* planned;
    Descriptor result;  // the pipe through which the process sends its record
    std::chrono::steady_clock::time_point started;
  };

  const RunSettings& settings_;
  std::map<pid_t, Running> running_;
};

}  // namespace relievo::app::batch
