// The folder that a batch fills. Tested by tests/cli/foreign_files and scripts/fault-campaign.
#pragma once

#include <filesystem>
#include <string>

#include "relievo/core/error.h"

namespace relievo::app::batch {

// Returns whether a batch may fill the folder. Nothing changes. Errors: of kind option if it has files of others, of kind
// output if it cannot be read.
Result<void> check_output_folder(const std::string& outputs);

// Creates the folder, marks it as that of a batch, and creates the folder `inner` inside it. Both may be
// missing, even during a run, as users may remove them. Errors: those of check_output_folder().
Result<void> make_output_folder(const std::string& outputs, const std::filesystem::path& inner = {});

}  // namespace relievo::app::batch
