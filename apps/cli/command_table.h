// Lists the commands of the program with their flags, for the man pages and the completion scripts of shells.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace relievo::app::cli {

// A flag or a positional argument.
struct FlagInfo {
  std::string name;                // "--height"; "input" for a positional argument
  std::string short_name;          // "-o"; may be empty
  std::string value;               // "MM"; empty if the flag takes no value
  std::string help;                // includes range and default
  std::vector<std::string> words;  // possible values, or their beginnings; empty if any value is possible
  bool is_argument = false, is_path = false, can_repeat = false, is_required = false;
};

struct CommandInfo {
  std::string name, help;
  std::vector<FlagInfo> flags;  // in the order of the help
};

// Returns the commands that appear in the help, in the same order.
std::vector<CommandInfo> command_table(const CLI::App& program);

// Return the man pages of the program and of one of its commands, in roff.
std::string program_man_page(const std::vector<CommandInfo>& commands);
std::string command_man_page(const CommandInfo& command);

// Returns the completion script for a shell; empty for shells other than bash, zsh and fish.
std::string completion_script(const std::vector<CommandInfo>& commands, const std::string& shell);

}  // namespace relievo::app::cli
