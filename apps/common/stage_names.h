// Turns the names of stages into readable ones, and lists facts about the program for the studio and the
// packages.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string_view>

namespace relievo::app {

// Returns the readable name of a stage that the library or a program reports to Progress. Returns an unknown
// name unchanged.
std::string_view name_of_stage(std::string_view stage);

// Returns an object with version, stages (which maps the names that Progress gets to readable names), formats
// (see format_list()), endings of files that can be read, and samples with their descriptions.
nlohmann::json program_facts();

}  // namespace relievo::app
