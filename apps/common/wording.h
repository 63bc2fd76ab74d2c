// Turns the facts that the library returns into sentences for users of the command line and the studio.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "relievo/make_relief.h"

namespace relievo::app {

// A fact that a user should know, without a capital and a full stop. If `option` is not empty, setting that
// option to `value` would change the fact, and `effect` describes the change.
struct Remark {
  std::string text;
  std::string_view option = {}, value = {}, effect = {};
};

// Return the facts that a user should know. `outliers` is the number of points left out before the scan was
// prepared.
std::vector<Remark> remarks_on(const ScanReport& scan, std::size_t outliers = 0);
std::vector<std::string> remarks_on(const ReliefReport& report);

// Returns the line with a capital at its beginning and a full stop at its end.
std::string as_sentence(std::string line);

// Returns ", found " and the wrong value of a JSON file, written as JSON and cut after 32 bytes; ", found
// none" for null.
std::string found(const nlohmann::json& value);

// Returns the known name that a user most likely meant by `typed`: the first name with the smallest edit
// distance. Returns an empty text if the distance is more than two and more than a third of the letters. If
// `typed` has at least four characters, dashes included, and a name begins with them, the distance of this
// name counts as one: "--out" means --output, although --up is nearer.
std::string nearest_name(std::string_view typed, const std::vector<std::string>& names);

}  // namespace relievo::app
