// Chooses the folder in which a studio keeps its work, and reserves it. Tested by tests/cli/foreign_files.
#pragma once

#include <string>

#include "common/descriptor.h"

namespace relievo::app::studio {

struct StateFolder {
  std::string path;
  std::string notice;    // message for the page's user, without a path; usually empty
  std::string detail;    // sentence with the path, for the terminal only
  bool is_ours = false;  // if false, nothing in the folder may be read or changed
  Descriptor lock{-1};   // while this is open, no other studio can take the folder
};

// Returns whether a folder belongs to a studio, which marks it. Makes the folder with its mark if it is
// missing.
bool own_state_folder(const std::string& folder);

// Reserves the folder `chosen` for this studio, or the default folder if `chosen` is empty. If another studio
// uses the folder, tries the names with -2, -3 and so on. Never takes a folder with files of others: if it is
// the default one, tries the next name. Errors: kind option if `chosen` has files of others.
Result<StateFolder> take_state_folder(const std::string& chosen);

}  // namespace relievo::app::studio
