// Lets JavaScript call functions by name. Each function takes JSON, and returns JSON and bytes.
#pragma once

#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "relievo/core/error.h"

namespace relievo::app::web {

struct CallAnswer {
  nlohmann::json json = nlohmann::json::object();
  std::vector<std::byte> bytes = {};
};

// Calls the function of that name. If the function makes an object that stays alive, its answer has a number by which
// later calls refer to that object. Errors: those of the function; kind option for an unknown name.
Result<CallAnswer> call(std::string_view name, const nlohmann::json& arguments);

}  // namespace relievo::app::web
