// Names for people of the stages of a long call, and what else programs without a help text tell of themselves.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string_view>

namespace relievo::app {

// Returns the name of a stage that the library or a program reports; of others what Progress calls them.
std::string_view name_of_stage(std::string_view stage);

// Returns version, stages (names by what Progress calls them), formats (see format_list()), endings of files that can be
// read, and samples with their descriptions.
nlohmann::json program_facts();

}  // namespace relievo::app
