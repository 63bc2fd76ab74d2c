// Fuzz target of options and projects. A line "name=text" sets an option. The whole input is also read as a
// project. An error must say what was expected, and an error about options must name the option.
#include <cstdlib>
#include <string>

#include "common/project.h"
#include "fuzz/fuzz_program.h"
#include "relievo/option_table.h"

using namespace relievo;

void run_target(std::string_view input) {
  OptionValues values;
  for (std::size_t begin = 0; begin < input.size();) {
    const std::size_t end = std::min(input.find('\n', begin), input.size());
    const std::string_view line = input.substr(begin, end - begin);
    const std::size_t equals = line.find('=');
    if (equals != std::string_view::npos && find_option(line.substr(0, equals)))
      values.emplace(line.substr(0, equals), std::string(line.substr(equals + 1)));
    begin = end + 1;
  }
  const auto options = parse_options(values);
  if (!options && (options.error().input.empty() || options.error().expected.empty())) std::abort();
  const auto project = app::read_project(input, "a.relievo");
  if (!project && project.error().expected.empty()) std::abort();
}
