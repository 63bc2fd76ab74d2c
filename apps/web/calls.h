// The functions that JavaScript can call, by name, with JSON in, and JSON and bytes out.
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

// Calls the function of that name. What it makes and keeps has a number, by which later calls name it. Errors: those of
// the function; kind option for an unknown name.
Result<CallAnswer> call(std::string_view name, const nlohmann::json& arguments);

}  // namespace relievo::app::web
