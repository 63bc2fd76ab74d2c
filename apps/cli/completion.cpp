// Makes completion scripts for shells from the table of commands.
#include <string_view>

#include "cli/command_table.h"
#include "common/read_inputs.h"
#include "relievo/core/text.h"

namespace relievo::app::cli {
namespace {

using Commands = std::vector<CommandInfo>;

std::string escaped(std::string_view text, std::string_view characters) {
  std::string out;
  for (const char c : text) {
    if (characters.find(c) != std::string_view::npos) out += '\\';
    out += c;
  }
  return out;
}

// Returns the first clause of a help text. This clause is short enough to stand beside the flag.
std::string brief(const std::string& help) {
  return help.substr(0, std::min({help.find("; "), help.find(" ["), help.find(": "), help.find(", ")}));
}

// ------------------------------------------------------------------------------------------------------- bash

constexpr std::string_view bash_head =
    R"(# Completion of relievo for bash; made by: relievo options --completion bash
_relievo() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} words=
  local paths=
  [ "$word" != = ] || word=
  [ "$before" != = ] || before=${COMP_WORDS[COMP_CWORD - 2]}
  COMPREPLY=()
)";

constexpr std::string_view bash_end = R"(  if [ -n "$paths" ]; then
    compopt -o filenames 2>/dev/null
    mapfile -t COMPREPLY < <(compgen -f -- "$word")
  elif [ -n "$words" ]; then
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
  fi
}
complete -F _relievo relievo
)";

std::string bash_names(const CommandInfo& command, const FlagInfo& flag) {
  const std::string name = cat(command.name, ":", flag.name);
  return flag.short_name.empty() ? name : cat(name, "|", command.name, ":", flag.short_name);
}

// Returns the branches of the script's first `case`. These branches complete the value of a flag.
std::string bash_values(const CommandInfo& command) {
  std::string text, numbers;
  for (const FlagInfo& flag : command.flags) {
    if (flag.is_argument || flag.value.empty()) continue;
    const std::string names = bash_names(command, flag);
    if (flag.is_path)
      text += cat("    ", names, ") paths=1 ;;\n");
    else if (!flag.words.empty())
      text += cat("    ", names, ") words='", joined(flag.words, " "), "' ;;\n");
    else
      numbers += cat(numbers.empty() ? "" : "|", names);
  }
  return numbers.empty() ? text : cat(text, "    ", numbers, ") return ;;\n");
}

// Returns the script's branch that completes the flags and arguments of one command.
std::string bash_flags(const CommandInfo& command) {
  std::string flags, argument = "paths=1";
  for (const FlagInfo& flag : command.flags) {
    if (!flag.is_argument) flags += cat(flags.empty() ? "" : " ", flag.name);
    if (flag.is_argument && !flag.words.empty()) argument = cat("words='", joined(flag.words, " "), "'");
  }
  return cat("      ", command.name, ") if [[ $word == -* ]]; then words='", flags, "'; else ", argument,
             "; fi ;;\n");
}

std::string bash_script(const Commands& commands) {
  std::string names, values, flags;
  for (const CommandInfo& command : commands) {
    names += cat(names.empty() ? "" : " ", command.name);
    values += bash_values(command);
    flags += bash_flags(command);
  }
  return cat(bash_head, "  if [ \"$COMP_CWORD\" -eq 1 ]; then words='", names, " --help --version'; else\n",
             "  case ${COMP_WORDS[1]}:$before in\n", values, "    *) case ${COMP_WORDS[1]} in\n", flags,
             "    esac ;;\n  esac\n  fi\n", bash_end);
}

// -------------------------------------------------------------------------------------------------------- zsh

std::string zsh_text(const std::string& help) {
  std::string text;
  for (const char c : escaped(brief(help), "[]:\\"))
    text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text;
}

std::string zsh_flag(const FlagInfo& flag) {
  const std::string action = flag.is_path         ? "_files"
                             : flag.words.empty() ? " "
                                                  : cat("(", joined(flag.words, " "), ")");
  const std::string value = flag.value.empty() ? "" : cat(":", escaped(flag.value, ":[]\\"), ":", action);
  if (flag.is_argument) return cat("'", flag.can_repeat ? "*" : "1", value, "'");
  const std::string rest = cat("[", zsh_text(flag.help), "]", value, "'");
  if (flag.short_name.empty()) return cat("'", flag.name, rest);
  return cat("'(", flag.short_name, " ", flag.name, ")'{", flag.short_name, ",", flag.name, "}'", rest);
}

std::string zsh_script(const Commands& commands) {
  std::string text =
      "#compdef relievo\n# Made by: relievo options --completion zsh\n_relievo() {\n"
      "  local -a commands=(\n";
  for (const CommandInfo& command : commands)
    text += cat("    '", command.name, ":", zsh_text(command.help), "'\n");
  text +=
      "  )\n  if (( CURRENT == 2 )); then _describe command commands; return; fi\n"
      "  local command=$words[2]\n  shift words\n  (( CURRENT-- ))\n  case $command in\n";
  for (const CommandInfo& command : commands) {
    text += cat("    ", command.name, ") _arguments");
    for (const FlagInfo& flag : command.flags) text += cat(" \\\n      ", zsh_flag(flag));
    text += " ;;\n";
  }
  return text +
         "  esac\n}\ncompdef _relievo relievo 2>/dev/null\n[[ $funcstack[1] != _relievo ]] || _relievo "
         "\"$@\"\n";
}

// ------------------------------------------------------------------------------------------------------- fish

std::string fish_text(const std::string& text) {
  return cat("'", escaped(text, "'\\"), "'");
}

std::string fish_flag(const CommandInfo& command, const FlagInfo& flag) {
  std::string text = cat("complete -c relievo -n '__fish_seen_subcommand_from ", command.name, "'");
  const std::string words = flag.words.empty() ? "" : cat(" -a ", fish_text(joined(flag.words, " ")));
  if (flag.is_argument) return cat(text, words.empty() ? " -F" : words, "\n");
  text += cat(" -l ", flag.name.substr(2));
  if (!flag.short_name.empty()) text += cat(" -s ", flag.short_name.substr(1));
  if (!flag.value.empty()) text += flag.is_path ? " -r -F" : cat(" -x", words);
  return cat(text, " -d ", fish_text(brief(flag.help)), "\n");
}

std::string fish_script(const Commands& commands) {
  std::string text =
      "# Completion of relievo for fish; made by: relievo options --completion fish\n"
      "complete -c relievo -f\n";
  for (const CommandInfo& command : commands) {
    text += cat("complete -c relievo -n __fish_use_subcommand -a ", command.name, " -d ",
                fish_text(command.help), "\n");
    for (const FlagInfo& flag : command.flags) text += fish_flag(command, flag);
  }
  return text;
}

}  // namespace

std::string completion_script(const Commands& commands, const std::string& shell) {
  if (shell == "bash") return bash_script(commands);
  if (shell == "zsh") return zsh_script(commands);
  if (shell == "fish") return fish_script(commands);
  return {};
}

}  // namespace relievo::app::cli
