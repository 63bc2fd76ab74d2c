// Lists the options of the table for the page, the documents and the packages.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "relievo/option_table.h"

namespace relievo::app {

// Returns the default as a text for users: "5", "0.04 with method layered, 0.02 with method paper".
std::string default_text(const OptionRow& option);

// Returns the help, with the range of a number or the words that the option takes.
std::string help_text(const OptionRow& option);

// Returns a list of objects with name, unit, help and stage; numbers also have min and max, and enumerations
// choices. `default` is there if the option has a default: its value or, where methods differ, an object of
// method names and values. `default_with` has the defaults that replace it: with a form, under the form's
// name, and with a diameter, under "diameter". `in_studio` and `is_stated` are those of OptionRow.
nlohmann::json option_list();

// Returns the name of an option as an argument of a function, with its unit: "height_mm".
std::string keyword_of(const OptionRow& option);

// Returns the rows of option_list(), with its keyword and default_text for each.
nlohmann::json keyword_list();

// Returns the rows of the table in docs/options.md.
std::string option_markdown();

}  // namespace relievo::app
