// Makes man pages from the table of commands.
#include <algorithm>

#include "cli/command_table.h"
#include "relievo/core/text.h"
#include "relievo/core/version.h"

namespace relievo::app::cli {
namespace {

std::string replaced(std::string text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

// Escapes a text for roff. Otherwise roff would print a dash as a hyphen, and treat a line that begins with a
// dot or a quote as a command.
std::string roff(std::string_view text) {
  const std::string escaped = replaced(replaced(std::string(text), "\\", "\\e"), "-", "\\-");
  return escaped.starts_with('.') || escaped.starts_with('\'') ? "\\&" + escaped : escaped;
}

std::string head(const std::string& page, const std::string& purpose) {
  std::string upper = page;
  std::ranges::transform(upper, upper.begin(),
                         [](char c) { return c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c; });
  return cat(".TH ", roff(upper), " 1 \"\" \"relievo ", version, "\" \"User Commands\"\n.SH NAME\n",
             roff(page), " \\- ", roff(purpose), "\n.SH SYNOPSIS\n");
}

std::string first_lower(std::string text) {
  if (!text.empty() && text[0] >= 'A' && text[0] <= 'Z') text[0] = static_cast<char>(text[0] - 'A' + 'a');
  return text;
}

std::string synopsis(const CommandInfo& command) {
  std::string text = cat(".B relievo ", roff(command.name), "\n");
  for (const FlagInfo& flag : command.flags) {
    const std::string dots = flag.can_repeat ? "..." : "";
    if (flag.is_argument)
      text += flag.is_required ? cat(".I ", roff(flag.value), dots, "\n")
                               : cat(".RI [ \" ", roff(flag.value), " \" ]\n");
    else if (flag.is_required)
      text += cat(".B ", roff(flag.short_name.empty() ? flag.name : flag.short_name), "\n.I ",
                  roff(flag.value), "\n");
  }
  return text + ".RI [ options ]\n";
}

std::string entry(const FlagInfo& flag) {
  std::string names = flag.is_argument ? "" : roff(flag.name);
  if (!flag.short_name.empty()) names = cat(roff(flag.short_name), ", ", names);
  const std::string head = flag.is_argument     ? cat(".I ", roff(flag.value))
                           : flag.value.empty() ? cat(".B ", names)
                                                : cat(".BI \"", names, " \" \"", roff(flag.value), "\"");
  return cat(".TP\n", head, "\n", roff(flag.help), "\n");
}

constexpr std::string_view man_end =
    ".SH EXIT STATUS\n0 on success, 1 for bad input or output, 2 for misuse. An error is one line on "
    "standard "
    "error. Either all output files are written or, on any error, none.\n";

}  // namespace

std::string program_man_page(const std::vector<CommandInfo>& commands) {
  std::string text = head("relievo", "turn a 3D scan into a bas-relief");
  text +=
      ".B relievo\n.I COMMAND\n.RI [ options ]\n.SH DESCRIPTION\nRelievo turns 3D scans into bas\\-reliefs: "
      "solids of exactly the height asked for, to be printed, milled or struck.\n.SH COMMANDS\n";
  for (const CommandInfo& command : commands)
    text += cat(".TP\n.BR relievo\\-", command.name, " (1)\n", roff(command.help), "\n");
  text +=
      ".SH EXAMPLES\n.nf\nrelievo sample shell \\-o shell.ply\n"
      "relievo make shell.ply \\-o shell.stl \\-\\-width 80 \\-\\-height 4 \\-\\-preview shell.png\n.fi\n";
  return text + std::string(man_end);
}

std::string command_man_page(const CommandInfo& command) {
  std::string text = head("relievo-" + command.name, first_lower(command.help)) + synopsis(command);
  text += ".SH OPTIONS\n";
  for (const FlagInfo& flag : command.flags) text += entry(flag);
  return text + std::string(man_end) + ".SH SEE ALSO\n.BR relievo (1)\n";
}

}  // namespace relievo::app::cli
