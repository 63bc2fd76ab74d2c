// The names of a long call's stages, in words for users.
#pragma once

#include <span>
#include <string_view>

namespace relievo::app {

struct StageName {
  std::string_view stage;  // as Progress reports it
  std::string_view text;
};

// Returns the names of all stages that the library and the programs report.
std::span<const StageName> stage_names();

// Returns the name of a stage; for other stages, the name that Progress has.
std::string_view name_of_stage(std::string_view stage);

}  // namespace relievo::app
