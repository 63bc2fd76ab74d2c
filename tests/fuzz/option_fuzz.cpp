// Fuzz target of options and projects: a line "name=text" sets an option as it is typed, and all of the bytes are read as
// a project. What is accepted is within its range; what is refused names an option.
#include <cstdlib>
#include <string>

#include "common/project.h"
#include "fuzz/fuzz_program.h"
#include "relievo/core/length.h"
#include "relievo/option_texts.h"
#include "relievo/options.h"

namespace {

using namespace relievo;

void set(OptionTexts& texts, std::string_view name, const std::string& text) {
  visit(texts, [&](const OptionField& field, auto& value) {
    if (field.name != name) return;
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value)>, std::string>) value = text;
  });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view whole(reinterpret_cast<const char*>(data), size);
  OptionTexts texts;
  for (std::size_t begin = 0; begin < whole.size();) {
    const std::size_t end = std::min(whole.find('\n', begin), whole.size());
    const std::string_view line = whole.substr(begin, end - begin);
    if (const std::size_t equals = line.find('='); equals != std::string_view::npos)
      set(texts, line.substr(0, equals), std::string(line.substr(equals + 1)));
    begin = end + 1;
  }
  const auto options = parse_options(texts);
  if (!options && (options.error().input.empty() || options.error().expected.empty())) std::abort();
  const auto project = app::read_project(whole, "a.relievo");
  if (!project && project.error().expected.empty()) std::abort();
  return 0;
}

RELIEVO_RUN_FILES
