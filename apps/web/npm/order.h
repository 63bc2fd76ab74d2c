// Orders for reliefs as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "common/make_order.h"

namespace relievo::app::web {

// An order for the files of these paths.
struct FileOrder : MakeOrder {
  std::vector<std::string> inputs;
};

// Reads {"inputs": [paths], "options": {name: number or text}, "camera": text, "base_image": path, "stream_above_mb":
// number}; each may be missing. Options have the names of the command line; lengths may be texts with a unit. Errors:
// kind option, naming the option.
Result<FileOrder> order_from(const nlohmann::json& json);

// Reads the files of an order, which may be one project. Errors: those of options_of(), read_scene(), unpack_project(),
// read_project() and load_input().
Result<LoadedOrder> load(const FileOrder& order, Progress& progress);

}  // namespace relievo::app::web
