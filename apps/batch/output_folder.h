// Checks and creates the folder that a batch fills. Tested by tests/cli/foreign_files and
// scripts/fault-campaign.
#pragma once

#include <filesystem>
#include <string>

#include "relievo/core/error.h"

namespace relievo::app::batch {

// Checks that a batch may fill the folder, and changes nothing. Errors: kind option if the folder has files
// of others; kind output if it cannot be read.
Result<void> check_output_folder(const std::string& outputs);

// Creates the folder, marks it as that of a batch, and creates the folder `inner` inside it. This is done
// again during a run, as users may remove the folders. Errors: those of check_output_folder().
Result<void> make_output_folder(const std::string& outputs, const std::filesystem::path& inner = {});

}  // namespace relievo::app::batch
