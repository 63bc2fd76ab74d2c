#include "batch/run.h"

#include <fcntl.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <nlohmann/json.hpp>
#include <span>

#include "batch/memory_need.h"
#include "common/descriptor.h"
#include "relievo/core/text.h"

namespace relievo::app::batch {
namespace {

std::string read_all(int descriptor) {
  std::string text;
  std::array<char, 4096> piece{};
  for (;;) {
    const ssize_t got = ::read(descriptor, piece.data(), piece.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return text;
    text.append(piece.data(), static_cast<std::size_t>(got));
  }
}

// Does the job in its own process, and sends the record to the parent.
[[noreturn]] void run_in_child(const PlannedJob& planned, const RunSettings& settings, int threads, int pipe,
                               pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);     // when the parent ends, this process gets SIGTERM
  if (::getppid() != parent) ::_exit(0);  // the parent ended before prctl() was called
  const JobResult result = perform(planned, settings, threads);
  nlohmann::json json = to_json(result.record);
  json["is_kept"] = result.is_kept;
  const std::string text = json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  // If write_all() fails, the parent gets no record, and reports how this process ended.
  (void)write_all(pipe, std::as_bytes(std::span(text)));
  std::fflush(stderr);
  ::_exit(0);  // does not run the destructors of static objects, which belong to the parent
}

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

std::string reason_of(int status) {
  // A process whose allocation fails prints a line and exits with code 1.
  if (WIFEXITED(status) && WEXITSTATUS(status) == 1) return "expected more free memory, found none left";
  if (!WIFSIGNALED(status))
    return cat("expected a result, found the end of its process with ", WEXITSTATUS(status));
  const int signal = WTERMSIG(status);
  return cat("expected a result, found its process ended by signal ", signal, " (", ::strsignal(signal), ")",
             signal == SIGKILL ? ", as happens when memory is short" : "");
}

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

Result<void> Processes::start(const PlannedJob& planned, int threads) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0)
    return system_error(ErrorKind::output, planned.job.name, "expected a pipe to a new process");
  Descriptor from(ends[0]), to(ends[1]);
  std::fflush(nullptr);  // otherwise both processes would print the buffered text
  const pid_t parent = ::getpid(), child = ::fork();
  if (child < 0) return system_error(ErrorKind::output, planned.job.name, "expected a new process");
  if (child == 0) run_in_child(planned, settings_, threads, to.number(), parent);
  running_.emplace(child, Running{&planned, std::move(from), std::chrono::steady_clock::now()});
  return {};
}

JobResult Processes::wait() {
  int status = 0;
  struct rusage usage {};
  pid_t child = 0;
  do child = ::wait4(-1, &status, 0, &usage);
  while (child < 0 && errno == EINTR);
  const auto found = running_.find(child);
  if (found == running_.end()) return {};
  const Running& process = found->second;
  const std::string text = read_all(process.result.number());
  const Job& job = process.planned->job;
  JobResult result;
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (const auto record = record_from_line(text)) {
    result = {json.value("is_kept", false), *record};
  } else {
    result.record = {job.name, job.file};
    result.record.error = cat(job.file, ": ", reason_of(status));
    result.record.may_succeed = true;
  }
  if (!result.is_kept) {
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - process.started;
    result.record.seconds = seconds.count();
    result.record.cpu_seconds = seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
    result.record.peak_mb = static_cast<double>(usage.ru_maxrss) / 1024;
    result.record.host = host_name();
    result.record.finished = time_now();
  }
  running_.erase(found);
  return result;
}

double Processes::running_mb() const {
  double mb = 0;
  for (const auto& [child, process] : running_) mb += process.planned->need_mb;
  return mb;
}

Result<void> run(const std::vector<PlannedJob>& planned, const RunSettings& settings, const RunLimits& limits,
                 const Journal& journal, const RunWatcher& watcher) {
  return Run(planned, settings, limits).all(journal, watcher);
}

}  // namespace relievo::app::batch
