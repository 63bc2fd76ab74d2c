// Writes the pages and the list of records at the end of a run. Tested by tests/cli/batch_test.cpp.
#pragma once

#include <string>
#include <vector>

#include "batch/perform.h"

namespace relievo::app::batch {

struct Summary {
  std::size_t made = 0, failed = 0, missing = 0;
};

// Returns how many of the jobs are made, how many have failed, and how many have not been done yet.
Summary summary_of(const std::vector<Job>& jobs, const Records& records);

// Returns groups of at least two jobs that are made from the same content with the same options: the names of
// the jobs in each group.
std::vector<std::vector<std::string>> same_scans(const std::vector<Job>& jobs, const Records& records);

// Writes into the folder of the outputs: scans.jsonl, the last record of each job in the order of the jobs;
// contact sheets of all previews; and index.html, the page of index_page(). Errors: kind output.
Result<void> finish(const std::vector<Job>& jobs, const Records& records, const Workshop& workshop);

}  // namespace relievo::app::batch
