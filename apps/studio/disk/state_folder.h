// Chooses the folder in which a studio stores documents and scans, and reserves it. Tested by
// tests/cli/foreign_files.
#pragma once

#include <string>

#include "common/descriptor.h"

namespace relievo::app::studio {

struct StateFolder {
  std::string path;
  std::string notice;    // message for the user of the page, without a path; usually empty
  std::string detail;    // sentence with the path, only for the terminal
  bool is_ours = false;  // false: the studio must not read or change anything in the folder
  Descriptor lock{-1};   // while this file is open, no other studio can take the folder
};

// Makes the folder with the mark of a studio if it is missing. Returns whether the folder now has that mark.
bool own_state_folder(const std::string& folder);

// Reserves the folder `chosen` for this studio, or the default folder if `chosen` is empty. If another studio
// uses it, tries the same name with -2, -3 and so on. Never takes a folder with files of other programs: if
// the default folder has such files, tries the next name. Errors: kind option if `chosen` has such files.
Result<StateFolder> take_state_folder(const std::string& chosen);

}  // namespace relievo::app::studio
