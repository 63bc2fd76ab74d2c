// Marks the folders that the program fills and cleans up, so that it never deletes files of others. Tested by
// tests/cli/foreign_files.
#pragma once

#include <string>
#include <string_view>

namespace relievo::app {

enum class Ownership {
  owned,      // the folder has the owner's mark
  free,       // the folder is missing or empty
  of_others,  // the folder has files but not the owner's mark
  unusable,   // the folder cannot be read, made or written to; errno has the reason
};

// Returns who owns the folder, and changes nothing. A folder belongs to an owner, such as "studio", only if
// it has the mark that own_folder() writes for that owner.
Ownership ownership_of(const std::string& folder, std::string_view owner);

// Makes the folder with the permissions `mode` if it is missing, and marks it if it was missing or empty.
// Returns `owned` if the folder now has the owner's mark. Changes nothing in a folder of others.
Ownership own_folder(const std::string& folder, std::string_view owner, unsigned mode = 0777);

}  // namespace relievo::app
