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
[[noreturn]] void live(const Work& work, const Workshop& workshop, int threads, int result, pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);     // the signal to this process when the parent ends
  if (::getppid() != parent) ::_exit(0);  // the parent ended before prctl() was called
  const Performed end = perform(work, workshop, threads);
  nlohmann::json json = to_json(end.record);
  json["is_kept"] = end.is_kept;
  const std::string text = json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  // If the writing fails, the parent gets no record, and reports how the process ended.
  (void)write_all(result, std::as_bytes(std::span(text)));
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

// Returns the number of processors that this process may use. A workload manager may limit it.
int usable_processors() {
  cpu_set_t set;
  return ::sched_getaffinity(0, sizeof set, &set) == 0 ? std::max(1, CPU_COUNT(&set)) : 1;
}

// Starts jobs as soon as there are enough processors and memory for them.
class Run {
 public:
  Run(const std::vector<Work>& works, const Workshop& workshop, const RunLimits& limits)
      : works_(works), processes_(workshop) {
    most_processes_ = limits.processes > 0 ? limits.processes : processors_;
    memory_mb_ = limits.memory_mb > 0 ? limits.memory_mb : share_of_available * available_memory_mb();
  }

  Result<void> all(const Journal& journal, const RunWatcher& watcher) {
    for (std::size_t done = 0; done < works_.size();) {
      RELIEVO_CHECK(start_what_fits());
      const Performed end = processes_.wait();
      if (!end.is_kept) RELIEVO_CHECK(journal.append(end.record));
      watcher(end, ++done);
    }
    return {};
  }

 private:
  Result<void> start_what_fits() {
    while (next_ < works_.size() && static_cast<int>(processes_.running()) < most_processes_) {
      const Work& work = works_[next_];
      if (processes_.running() > 0 && processes_.running_mb() + work.need_mb > memory_mb_) break;
      RELIEVO_CHECK(processes_.start(work, threads_for(work)));
      ++next_;
    }
    return {};
  }

  // One process per processor is fastest. If the memory or the number of remaining jobs allows fewer
  // processes than processors, each process gets several threads.
  int threads_for(const Work& work) const {
    const double side_by_side =
        std::min({static_cast<double>(most_processes_), static_cast<double>(works_.size() - next_),
                  std::max(1.0, std::floor(memory_mb_ / std::max(work.need_mb, 1.0)))});
    return std::max(1, static_cast<int>(processors_ / side_by_side));
  }

  const std::vector<Work>& works_;
  Processes processes_;
  std::size_t next_ = 0;  // index of the next job to start
  int processors_ = usable_processors(), most_processes_ = 1;
  double memory_mb_ = 0;
};

}  // namespace

Result<void> Processes::start(const Work& work, int threads) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0)
    return system_error(ErrorKind::output, work.job.name, "expected a pipe to a new process");
  Descriptor from(ends[0]), to(ends[1]);
  std::fflush(nullptr);  // otherwise both processes would print the buffered text
  const pid_t parent = ::getpid(), child = ::fork();
  if (child < 0) return system_error(ErrorKind::output, work.job.name, "expected a new process");
  if (child == 0) live(work, workshop_, threads, to.number(), parent);
  running_.emplace(child, Running{&work, std::move(from), std::chrono::steady_clock::now()});
  return {};
}

Performed Processes::wait() {
  int status = 0;
  struct rusage usage {};
  pid_t child = 0;
  do child = ::wait4(-1, &status, 0, &usage);
  while (child < 0 && errno == EINTR);
  const auto found = running_.find(child);
  if (found == running_.end()) return {};
  const Running& process = found->second;
  const std::string text = read_all(process.result.number());
  const Job& job = process.work->job;
  Performed end;
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (const auto record = record_from_line(text)) {
    end = {json.value("is_kept", false), *record};
  } else {
    end.record = {job.name, job.file};
    end.record.error = cat(job.file, ": ", reason_of(status));
    end.record.may_succeed = true;
  }
  if (!end.is_kept) {
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - process.started;
    end.record.seconds = seconds.count();
    end.record.cpu_seconds = seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
    end.record.peak_mb = static_cast<double>(usage.ru_maxrss) / 1024;
    end.record.host = host_name();
    end.record.finished = time_now();
  }
  running_.erase(found);
  return end;
}

double Processes::running_mb() const {
  double mb = 0;
  for (const auto& [child, process] : running_) mb += process.work->need_mb;
  return mb;
}

Result<void> run(const std::vector<Work>& works, const Workshop& workshop, const RunLimits& limits,
                 const Journal& journal, const RunWatcher& watcher) {
  return Run(works, workshop, limits).all(journal, watcher);
}

}  // namespace relievo::app::batch
