#include "batch/run.h"

#include <sched.h>

#include <algorithm>
#include <cmath>

#include "batch/memory_need.h"
#include "batch/processes.h"

namespace relievo::app::batch {
namespace {

// Estimates may be wrong, and the system needs memory to cache files. So a fifth of the memory stays free.
constexpr double share_of_available = .8;

// Returns the number of processors that this process may use. A workload manager such as Slurm may limit this
// number.
int usable_processors() {
  cpu_set_t set;
  return ::sched_getaffinity(0, sizeof set, &set) == 0 ? std::max(1, CPU_COUNT(&set)) : 1;
}

// Starts jobs as soon as there are enough processors and memory for them.
class Run {
 public:
  Run(const std::vector<PlannedJob>& planned, const RunSettings& settings, const RunLimits& limits)
      : jobs_(planned), processes_(settings) {
    most_processes_ = limits.processes > 0 ? limits.processes : processors_;
    memory_mb_ = limits.memory_mb > 0 ? limits.memory_mb : share_of_available * available_memory_mb();
  }

  Result<void> all(const Journal& journal, const RunWatcher& watcher) {
    for (std::size_t done = 0; done < jobs_.size();) {
      RELIEVO_CHECK(start_what_fits());
      const JobResult result = processes_.wait();
      if (!result.is_kept) RELIEVO_CHECK(journal.append(result.record));
      watcher(result, ++done);
    }
    return {};
  }

 private:
  Result<void> start_what_fits() {
    while (next_ < jobs_.size() && static_cast<int>(processes_.running()) < most_processes_) {
      const PlannedJob& job = jobs_[next_];
      if (processes_.running() > 0 && processes_.running_mb() + job.need_mb > memory_mb_) break;
      RELIEVO_CHECK(processes_.start(job, threads_for(job)));
      ++next_;
    }
    return {};
  }

  // One process per processor is fastest. If the memory or the number of remaining jobs allows fewer
  // processes than processors, each process gets several threads.
  int threads_for(const PlannedJob& job) const {
    const double side_by_side =
        std::min({static_cast<double>(most_processes_), static_cast<double>(jobs_.size() - next_),
                  std::max(1.0, std::floor(memory_mb_ / std::max(job.need_mb, 1.0)))});
    return std::max(1, static_cast<int>(processors_ / side_by_side));
  }

  const std::vector<PlannedJob>& jobs_;
  Processes processes_;
  std::size_t next_ = 0;  // index of the next job to start
  int processors_ = usable_processors(), most_processes_ = 1;
  double memory_mb_ = 0;
};

}  // namespace

Result<void> run(const std::vector<PlannedJob>& planned, const RunSettings& settings, const RunLimits& limits,
                 const Journal& journal, const RunWatcher& watcher) {
  return Run(planned, settings, limits).all(journal, watcher);
}

}  // namespace relievo::app::batch
