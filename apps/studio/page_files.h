// Finds the files of the page, which are embedded in the program.
#pragma once

#include <string_view>

namespace relievo::app::studio {

struct PageFile {
  std::string_view name, type, bytes;
};

// Returns the file of that name; null if there is none.
const PageFile* find_page_file(std::string_view name);

}  // namespace relievo::app::studio
