// Turns the facts that the library returns into sentences for users of the command line and the studio.
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

// Return the facts that a user should know. `outliers` is the number of points left out before the scan was
// prepared.
std::vector<Remark> remarks_on(const ScanReport& scan, std::size_t outliers = 0);
std::vector<std::string> remarks_on(const ReliefReport& report);

// Returns the line with a capital and a full stop.
std::string as_sentence(std::string line);

// Returns ", found " and the value that a JSON file has instead of the expected one, in JSON, cut after 32
// bytes; ", found none" for null.
std::string found(const nlohmann::json& value);

// Returns the name that a user may have meant who typed an unknown one: the first of those with the fewest
// letters that differ. Returns an empty text if more than a third of the letters, and more than two, differ.
// The beginning of a name, of at least four letters, counts as one that differs: "--out" means --output,
// although --up has fewer.
std::string nearest_name(std::string_view typed, const std::vector<std::string>& names);

}  // namespace relievo::app
