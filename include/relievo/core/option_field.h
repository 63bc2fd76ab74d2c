// The name, description and range of an option, used wherever it is parsed or shown.
#pragma once

#include <limits>
#include <string_view>
#include <vector>

namespace relievo {

struct OptionField {
  std::string_view name;  // as a command-line flag without its dashes, as a key of JSON
  std::string_view unit;  // of the value, for help
  std::string_view help;  // one line, without range and default
  double min = -std::numeric_limits<double>::infinity();  // smallest and largest allowed value, of numbers
  double max = std::numeric_limits<double>::infinity();
  std::string_view otherwise = {};             // what rules without a value, for people
  std::vector<std::string_view> choices = {};  // all words that may stand there, or begin the text
};

}  // namespace relievo
