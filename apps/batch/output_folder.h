// Checks and creates the folder of a batch's outputs. Tested by tests/cli/foreign_files and
// scripts/fault-campaign.
#pragma once

#include <filesystem>
#include <string>

#include "relievo/core/error.h"

namespace relievo::app::batch {

// Checks that a batch may write into the folder, and changes nothing. Errors: kind option if the folder has
// files that no batch made; kind output if it cannot be read.
Result<void> check_output_folder(const std::string& outputs);

// Creates the folder, marks it as the folder of a batch, and creates the folder `inner` inside it. Each job
// calls this again, as the user may remove the folders during a run. Errors: those of check_output_folder().
Result<void> make_output_folder(const std::string& outputs, const std::filesystem::path& inner = {});

}  // namespace relievo::app::batch
