// Translates the names of stages for users, and lists facts about the program for the studio and the
// packages.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string_view>

namespace relievo::app {

// Returns the name for users of a stage that the library or a program reports to Progress. Returns an unknown
// name unchanged.
std::string_view name_of_stage(std::string_view stage);

// Returns an object with version, stages (from the names that Progress gets to the names for users), formats
// (see format_list()), the endings of readable files, and the samples with their descriptions.
nlohmann::json program_facts();

}  // namespace relievo::app
