// Writes the page that shows all reliefs of a catalogue. Tested by tests/cli/batch_pages_test.cpp.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "batch/finish.h"

namespace relievo::app::batch {

// Returns the page: the failed jobs with their errors, and a picture of each relief with links to its files.
// The page must be stored in the folder of the outputs, as its links and the paths of the contact sheets are
// relative to that folder.
std::string index_page(const std::vector<Job>& jobs, const Records& records, const RunSettings& settings,
                       const std::vector<std::string>& sheets);

// Converts a relative path to a relative URL: writes all characters except letters, digits and - . _ / as %XX.
std::string url_of_path(std::string_view path);

}  // namespace relievo::app::batch
