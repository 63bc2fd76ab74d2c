// Pieces of HTML pages. Tested by tests/cli/batch_pages_test.cpp.
#pragma once

#include <string>
#include <string_view>

namespace relievo::app {

// Returns the relative path as an address for a link, with all but letters, digits, - . _ / written as %XX.
std::string url_of_path(std::string_view path);

}  // namespace relievo::app
