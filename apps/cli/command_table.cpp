#include "cli/command_table.h"

#include <algorithm>
#include <cctype>

#include "relievo/core/text.h"
#include "relievo/option_table.h"
#include "relievo/relief/baseline_grid.h"
#include "relievo/samples/sample.h"

namespace relievo::app::cli {
namespace {

std::vector<std::string> all_names(const auto& infos) {
  std::vector<std::string> names;
  for (const auto& info : infos) names.emplace_back(info.name);
  return names;
}

// Returns the possible values of a flag. `name` is the flag without its dashes.
std::vector<std::string> words_of(const std::string& command, const std::string& name) {
  if (command == "sample" && name == "name") return all_names(samples());
  if (name == "units") return {"mm", "in"};
  if (name == "methods") {
    const std::vector<std::string_view> names = compared_methods();
    return {names.begin(), names.end()};
  }
  if (command == "bench" && name == "mode") return {"exact", "subspace", "auto", "all"};
  if (name == "view") return {"front", "back", "left", "right", "top", "bottom"};
  const OptionRow* const option = find_option(name);
  if (option == nullptr) return {};
  return {option->choices.begin(), option->choices.end()};
}

// Returns whether a flag takes a path. `value` is the placeholder in the flag's help. The placeholder of a
// path has an ending ("P.png") or is one of the words listed here.
bool is_path(const std::string& value) {
  const std::size_t dot = value.find('.');
  return value == "INPUT" || value == "OUT" || value == "DIR" || value == "FX,FY,CX,CY" ||
         (dot != std::string::npos && dot + 1 < value.size() &&
          std::isalpha(static_cast<unsigned char>(value[dot + 1])) != 0);
}

FlagInfo flag_info(const CLI::App& command, const CLI::Option& option) {
  FlagInfo flag;
  flag.is_argument = option.get_positional();
  const std::string plain = flag.is_argument ? option.get_name(true) : option.get_lnames().front();
  flag.name = flag.is_argument ? plain : "--" + plain;
  if (!option.get_snames().empty()) flag.short_name = "-" + option.get_snames().front();
  flag.value = option.get_items_expected_max() == 0 ? "" : option.get_type_name();
  flag.help = option.get_description();
  if (!option.get_default_str().empty() && !flag.value.empty())
    flag.help += cat("; default: ", option.get_default_str());
  flag.words = words_of(command.get_name(), plain);
  flag.is_path = flag.words.empty() && is_path(flag.value);
  flag.can_repeat = option.get_items_expected_max() > 1;
  flag.is_required = option.get_required();
  return flag;
}

}  // namespace

std::vector<CommandInfo> command_table(const CLI::App& program) {
  std::vector<CommandInfo> table;
  const auto is_shown = [](const CLI::App* command) { return !command->get_group().empty(); };
  for (const CLI::App* command : program.get_subcommands(is_shown)) {
    CommandInfo info{command->get_name(), command->get_description(), {}};
    for (const CLI::Option* option : command->get_options())
      if (!option->get_group().empty()) info.flags.push_back(flag_info(*command, *option));
    table.push_back(std::move(info));
  }
  return table;
}

}  // namespace relievo::app::cli
