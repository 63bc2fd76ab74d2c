// The page's files, part of the program.
#pragma once

#include <string_view>

namespace relievo::studio {

struct PageFile {
  std::string_view name, type, bytes;
};

// The file of that name; null if there is none.
const PageFile* find_page_file(std::string_view name);

}  // namespace relievo::studio
