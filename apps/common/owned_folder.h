// Marks the folders that the program fills and cleans up. Tested by tests/cli/foreign_files.
#pragma once

#include <string>
#include <string_view>

namespace relievo::app {

enum class Ownership {
  owned,      // the folder has the owner's mark
  free,       // it is missing or empty
  of_others,  // it has files of somebody else
  unusable,   // it cannot be read, made or written to; errno has the reason
};

// Returns who owns the folder, and changes nothing. A folder belongs to the owner, such as "studio", only if
// it has the mark that own_folder() writes.
Ownership ownership_of(const std::string& folder, std::string_view owner);

// Makes a folder with the permissions of `mode` if it is missing, and marks it if it is free. Returns owned
// if the folder is now the owner's. In a folder of others nothing changes.
Ownership own_folder(const std::string& folder, std::string_view owner, unsigned mode = 0777);

}  // namespace relievo::app
