// Translates the names of stages for users, and lists facts about the program for the studio and the
// packages.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string_view>

namespace relievo::app {

// Returns the name under which users see a stage. `stage` is the name that the library or a program reports
// to Progress. Returns an unknown name unchanged.
std::string_view name_of_stage(std::string_view stage);

// Returns an object with the keys version, stages (maps the names that Progress gets to the names that users
// see), formats (see format_list()), endings (of readable files), and samples (with their descriptions).
nlohmann::json program_facts();

}  // namespace relievo::app
