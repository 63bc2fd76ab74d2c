// Finds the place at which a text stops being JSON.
#pragma once

#include <string>
#include <string_view>

namespace relievo {

// Returns the place of the first character that cannot belong to a JSON text, "line 3, column 14"; empty if
// the text is JSON.
std::string json_error_place(std::string_view text);

}  // namespace relievo
