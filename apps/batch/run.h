// Does the jobs of a catalogue on this machine. Tested by tests/cli/batch_test.cpp.
#pragma once

#include <functional>
#include <vector>

#include "batch/perform.h"

namespace relievo::app::batch {

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
