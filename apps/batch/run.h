// Does the jobs of a catalogue on this machine, each in its own process. Tested by tests/cli/batch_test.cpp.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <functional>
#include <map>
#include <vector>

#include "batch/perform.h"

namespace relievo::app::batch {

// The processes of the running jobs. If one crashes, or if the system kills it for lack of memory, only its
// job fails. The processes are forks of this process that load no program, so a job starts faster than a
// shell command. The forks end when this process ends or crashes. This process must not have started a
// thread, and must have no other child processes.
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

struct RunLimits {
  int processes = 0;     // largest number of processes at the same time; 0: the number of processors
  double memory_mb = 0;  // memory of all processes together; 0: 80 % of the available memory
};

// Called after each job. `done` is the number of jobs that have ended.
using RunWatcher = std::function<void(const JobResult& result, std::size_t done)>;

// Does all jobs, in no fixed order, and as many at the same time as the limits allow. Appends a line to the
// journal for each job whose outputs were not up to date. A job that needs more memory than the limit runs alone.
// A failed job does not end the run. Errors: kind output if the journal or the processes fail.
Result<void> run(const std::vector<PlannedJob>& planned, const RunSettings& settings, const RunLimits& limits,
                 const Journal& journal, const RunWatcher& watcher);

}  // namespace relievo::app::batch
