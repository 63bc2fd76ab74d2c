// Lists the options of the table for the page, the documents and the packages.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "relievo/option_table.h"

namespace relievo::app {

// Returns the default as a text for users: "5", "0.04 with method layered, 0.02 with method paper".
std::string default_text(const OptionRow& option);

// Returns the help text, followed by the range of a number or by the words that the option accepts.
std::string help_text(const OptionRow& option);

// Returns a list of objects with name, unit, help and stage, one per option. Numbers also have min and max,
// and enumerations have choices. `default` is the option's default. If the default depends on the method,
// `default` is an object that maps methods to values; if there is no default, it is missing. `default_with`
// is an object with the defaults that replace `default` in special cases. Its keys are names of forms, and
// "diameter" for the case that a diameter is given. `in_studio` and `is_stated` are those of OptionRow.
nlohmann::json option_list();

// Returns an option's name in the form of a function parameter, which includes the unit: "height_mm".
std::string keyword_of(const OptionRow& option);

// Returns the rows of option_list(), each with its keyword_of() and default_text().
nlohmann::json keyword_list();

// Returns the rows of the table in docs/options.md.
std::string option_markdown();

}  // namespace relievo::app
