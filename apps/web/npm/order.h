// Orders for reliefs as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "common/make_order.h"

namespace relievo::app::web {

// Reads {"inputs": [paths], "options": {name: number or text}, "camera": text, "base_image": path, "stream_above_mb":
// number}; each may be missing. Options have the names of the command line; lengths may be texts with a unit. Errors:
// kind option, naming the option.
Result<MakeOrder> order_from(const nlohmann::json& json);

}  // namespace relievo::app::web
