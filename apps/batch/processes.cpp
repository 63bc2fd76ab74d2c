#include "batch/processes.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <nlohmann/json.hpp>
#include <span>

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

}  // namespace relievo::app::batch
