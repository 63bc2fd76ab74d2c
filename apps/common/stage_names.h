// Names of the stages of a long call that users can read, and facts about the program for the studio and the
// packages.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string_view>

namespace relievo::app {

// Returns the readable name of a stage that the library or a program reports to Progress. Returns the names
// of other stages unchanged.
std::string_view name_of_stage(std::string_view stage);

// Returns version, stages (readable names by the names that Progress gets), formats (see format_list()),
// endings of files that can be read, and samples with their descriptions.
nlohmann::json program_facts();

}  // namespace relievo::app
