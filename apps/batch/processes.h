// Runs each job in a process of its own, so that a crash, or a kill by the system for lack of memory, ends
// only that job. Tested by tests/cli/batch_test.cpp.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <map>

#include "batch/perform.h"

namespace relievo::app::batch {

// The processes of the running jobs. They are forks of this process and load no program, so a job costs less
// than a shell command. They end when this process ends, also if it crashes. This process must not have
// started a thread, and must have no other children.
class Processes {
 public:
  explicit Processes(const Workshop& workshop) : workshop_(workshop) {}

  // Starts the job; `threads` is the number of threads that it may use. Errors: kind output if there can be
  // no more processes.
  Result<void> start(const Work& work, int threads);

  // Waits until a job ends, in whatever way, and returns its outcome. At least one job must be running.
  Performed wait();

  std::size_t running() const { return running_.size(); }
  double running_mb() const;  // the sum of the running jobs' needs

 private:
  struct Running {
    const Work* work;
    Descriptor result;  // the pipe from which the record of the process is read
    std::chrono::steady_clock::time_point started;
  };

  const Workshop& workshop_;
  std::map<pid_t, Running> running_;
};

}  // namespace relievo::app::batch
