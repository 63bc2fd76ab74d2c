// The pages at the end of a run. Tested by tests/cli/batch_test.cpp.
#pragma once

#include <string>
#include <vector>

#include "batch/perform.h"

namespace relievo::app::batch {

struct Summary {
  std::size_t made = 0, failed = 0, missing = 0;
};

// Returns how many of the jobs are made, how many failed, and how many nobody has done yet.
Summary summary_of(const std::vector<Job>& jobs, const Records& records);

// Returns groups of made jobs with the same content and options: the names of each group. Jobs without a
// double are left out.
std::vector<std::vector<std::string>> same_scans(const std::vector<Job>& jobs, const Records& records);

// Writes into the folder of the outputs: scans.jsonl, the last record of each job in the order of the jobs;
// contact sheets of all previews; and index.html, the page of index_page(). Errors: kind output.
Result<void> finish(const std::vector<Job>& jobs, const Records& records, const Workshop& workshop);

}  // namespace relievo::app::batch
