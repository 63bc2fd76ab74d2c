// The page over all reliefs of a catalogue. Tested by tests/cli/batch_pages_test.cpp.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "batch/finish.h"

namespace relievo::app::batch {

// Returns the page: the failures with their errors, and a picture of each relief with links to its files. The
// page stands in the folder of the outputs. Its links and the paths of the contact sheets are relative to
// that folder.
std::string index_page(const std::vector<Job>& jobs, const Records& records, const Workshop& workshop,
                       const std::vector<std::string>& sheets);

// Returns the relative path as an address for a link, with all but letters, digits, - . _ / written as %XX.
std::string url_of_path(std::string_view path);

}  // namespace relievo::app::batch
