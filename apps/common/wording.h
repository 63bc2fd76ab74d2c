// Sentences for people, made of the facts that the library returns: for the command line and the studio alike.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "relievo/make_relief.h"

namespace relievo::app {

// A fact that a user should know, without capital and full stop. If `option` is not empty, setting it to
// `value` would change the fact; `effect` says how.
struct Remark {
  std::string text;
  std::string_view option = {}, value = {}, effect = {};
};

// Return the facts that a user should know. `outliers` is the number of points that were left out before.
std::vector<Remark> remarks_on(const ScanReport& scan, std::size_t outliers = 0);
std::vector<std::string> remarks_on(const ReliefReport& report);

// Returns the line with a capital and a full stop.
std::string as_sentence(std::string line);

// Returns ", found " and the value that a JSON file has in place of the expected one, as it is written in JSON, at most 32
// bytes of it; ", found none" for null.
std::string found(const nlohmann::json& value);

}  // namespace relievo::app
