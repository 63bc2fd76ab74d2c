// Names the value that a JSON file has in place of the expected one, for messages.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace relievo::app {

// Returns ", found " and the value as it is written in JSON, at most 32 bytes of it; ", found none" for null.
inline std::string found(const nlohmann::json& value) {
  if (value.is_null()) return ", found none";
  std::string text = value.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  if (text.size() > 32) text.replace(32, text.size(), "...");
  return ", found " + text;
}

}  // namespace relievo::app
