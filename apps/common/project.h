// Project files: a relief as work in progress, in JSON. The studio saves and opens them, `make` makes them.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "relievo/options.h"
#include "relievo/scene.h"

namespace relievo::studio {

// Where the points come from: a file, or a generated sample if `sample` is not empty.
struct Input {
  std::string sample;
  std::string path;
  std::string name;  // for people
  std::string hash;  // of the file's bytes, see hash_of(); empty if not known yet
};

struct Project {
  Input input;
  ReliefOptions options;
};

// Returns a project from the bytes of its file, called `name` in errors. Unknown options are errors, so that
// nothing is left out silently; what else is in the file belongs to the studio. Errors: kind input.
Result<Project> read_project(std::string_view text, std::string_view name);

// The options with the names that the command line gives them; those without a value are left out.
nlohmann::json to_json(const ReliefOptions& options);
Result<ReliefOptions> options_from_json(const nlohmann::json& json, std::string_view name);

nlohmann::json to_json(const Input& input);
Result<Input> input_from_json(const nlohmann::json& json, std::string_view name);

// Tells changed files from unchanged ones: 64 bits of FNV-1a. No protection against intent.
std::string hash_of(std::string_view bytes);

// Returns the model of the input, or the models of a scene file, and sets its hash if it has none. A relative
// path starts at `folder`. Errors: kind input, also if the file is not the one that the hash was taken from;
// kind option for an unknown sample.
Result<Scene> load_input(Input& input, const std::string& folder);

}  // namespace relievo::studio
