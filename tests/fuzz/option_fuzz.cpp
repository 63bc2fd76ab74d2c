// Fuzz target of options and projects. A line "name=text" sets an option. The whole input is also read as a
// project. An error must say what was expected, and an error about options must name the option.
#include <cstdlib>
#include <string>

#include "common/project.h"
#include "fuzz/fuzz_program.h"
#include "relievo/option_table.h"

using namespace relievo;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view whole(reinterpret_cast<const char*>(data), size);
  OptionValues values;
  for (std::size_t begin = 0; begin < whole.size();) {
    const std::size_t end = std::min(whole.find('\n', begin), whole.size());
    const std::string_view line = whole.substr(begin, end - begin);
    const std::size_t equals = line.find('=');
    if (equals != std::string_view::npos && find_option(line.substr(0, equals)))
      values.emplace(line.substr(0, equals), std::string(line.substr(equals + 1)));
    begin = end + 1;
  }
  const auto options = parse_options(values);
  if (!options && (options.error().input.empty() || options.error().expected.empty())) std::abort();
  const auto project = app::read_project(whole, "a.relievo");
  if (!project && project.error().expected.empty()) std::abort();
  return 0;
}

RELIEVO_RUN_FILES
