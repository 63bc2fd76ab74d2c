// The table of options for all who show it: the page and the README.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "relievo/option_texts.h"

namespace relievo::app {

// Returns what rules where the option is not given, for people: "5", "0.04 with method layered, 0.02 with method paper".
std::string default_text(const ReliefField& field);

// Returns the help, with the words that may stand there.
std::string help_text(const OptionField& field);

// Returns a list of objects with name, unit, help and slider (whether the studio shows it live); of numbers with min
// and max; of enumerations with choices. `default` is there if something rules without a value: itself, or, where
// methods differ, an object of method names and values.
nlohmann::json option_list();

// Returns the name of an option as an argument of a function, with its unit: "height_mm".
std::string keyword_of(const OptionField& field);

// Returns option_list() and then the options of depth images, whose entries have is_of_input; each with its keyword and
// default_text.
nlohmann::json keyword_list();

// Returns the rows of the README's table.
std::string option_markdown();

}  // namespace relievo::app
