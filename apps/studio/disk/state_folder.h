// The folder in which a studio keeps its work. Tested by tests/cli/foreign_files.
#pragma once

#include <string>

#include "common/descriptor.h"

namespace relievo::app::studio {

struct StateFolder {
  std::string path;
  std::string notice;    // what the page tells its user of it, without a path; usually empty
  std::string detail;    // what the terminal adds to the notice: the path
  bool is_ours = false;  // else nothing in it may be read, written or removed
  Descriptor lock{-1};   // no other studio has it while this is open
};

// Returns whether a folder has a studio's mark; one that is gone is made anew.
bool own_state_folder(const std::string& folder);

// Reserves the folder `chosen` for this studio alone, or the default one if `chosen` is empty. If another
// studio has it, tries the names with -2, -3 and so on. A folder with files of others is never taken; instead
// of such a default folder the next name is tried. Errors: kind option if `chosen` has files of others.
Result<StateFolder> take_state_folder(const std::string& chosen);

}  // namespace relievo::app::studio
