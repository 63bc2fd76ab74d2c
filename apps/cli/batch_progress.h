// Shows on standard error how many jobs of a batch are done.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

#include "batch/perform.h"

namespace relievo::app::cli {

// Shows a bar with the remaining time if standard error is a terminal. Otherwise prints a line after every
// twentieth of the jobs. In both cases prints a line for each failed job.
class BatchProgress {
 public:
  BatchProgress(std::size_t jobs, bool is_quiet);
  ~BatchProgress();
  BatchProgress(const BatchProgress&) = delete;
  BatchProgress& operator=(const BatchProgress&) = delete;

  // Shows that a job has ended; `done` is the number of jobs that have ended so far.
  void show(const batch::JobResult& result, std::size_t done);

 private:
  std::string line(std::size_t done) const;
  std::string time_left(std::size_t done) const;

  std::size_t jobs_;
  bool is_quiet_, is_terminal_;
  std::size_t failed_ = 0, kept_ = 0;
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
};

}  // namespace relievo::app::cli
