// Reads the fonts and ornaments that options name.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "relievo/option_table.h"

namespace relievo::app {

// Returns the ornaments of a JSON text, called `name` in errors. Relative paths start at the folder:
//   {"ornaments": [{"kind": "text", "text": "LIBERTAS", "arc": "top", "size": 3}, {"kind": "beads"},
//                  {"kind": "drawing", "file": "crest.svg", "size": 20, "at": [0, 30]}]}
// docs/lettering.md has all keys. Errors: kind input for a text that is not JSON, unknown keys, values of another
// type, and files that cannot be read.
Result<std::vector<Ornament>> parse_ornaments(std::string_view text, const std::string& name,
                                              const std::string& folder);

// Makes relative paths of the options `font` and `ornaments` of a project start at the project's folder.
void find_ornament_files(OptionValues& own, const std::string& folder);

// Reads the files that the options `font` and `ornaments` name. The text of `ornaments` is JSON itself if it begins
// with a brace. Errors: those of read_file() and parse_ornaments().
Result<void> read_ornaments(ReliefOptions& options);

}  // namespace relievo::app
