// Writes the pages and the list of records at the end of a batch. Tested by tests/cli/batch_test.cpp and
// tests/cli/batch_pages_test.cpp.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "batch/perform.h"

namespace relievo::app::batch {

struct Summary {
  std::size_t made = 0, failed = 0, missing = 0;
};

// Counts the jobs that succeeded, that failed, and that have not been done yet.
Summary summary_of(const std::vector<Job>& jobs, const Records& records);

// Finds jobs whose scans have the same content and whose options are equal. Returns each group of two or more
// such jobs as a list of their names.
std::vector<std::vector<std::string>> same_scans(const std::vector<Job>& jobs, const Records& records);

// Writes three things into the folder of the outputs: scans.jsonl, which contains the last record of each job
// in the order of the jobs; contact sheets of all previews; and index.html, see index_page(). Errors: kind
// output.
Result<void> finish(const std::vector<Job>& jobs, const Records& records, const RunSettings& settings);

// Returns the page: the failed jobs with their errors, and a picture of each relief with links to its files.
// The page must be stored in the folder of the outputs, as its links and the paths of the contact sheets are
// relative to that folder.
std::string index_page(const std::vector<Job>& jobs, const Records& records, const RunSettings& settings,
                       const std::vector<std::string>& sheets);

// Converts a relative path to a relative URL: writes all characters except letters, digits and - . _ / as %XX.
std::string url_of_path(std::string_view path);

}  // namespace relievo::app::batch
