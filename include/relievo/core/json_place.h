// Finds the position of a syntax error in JSON.
#pragma once

#include <string>
#include <string_view>

namespace relievo {

// Returns the position of the first character that cannot belong to a JSON text, such as "line 3, column 14";
// an empty text if `text` is JSON.
std::string json_error_place(std::string_view text);

}  // namespace relievo
