#include "cli/program.h"

#include <algorithm>
#include <iostream>
#include <new>
#include <sstream>
#include <system_error>
#include <utility>

#include "cli/commands.h"
#include "cli/terminal.h"
#include "common/wording.h"
#include "relievo/core/text.h"
#include "relievo/core/version.h"

namespace relievo::app::cli {
namespace {

// Returns the line to print for an error. If the error is about an option, its flag comes first: "--height:
// expected ...".
std::string line_of(Error error, const CLI::App& program) {
  const std::string flag = "--" + error.input;
  for (const CLI::App* command : program.get_subcommands())
    if (command->get_option_no_throw(flag) != nullptr) error.input = flag;
  return error.message();
}

// Returns the option or the command that the user may have meant; an empty text if none is similar.
std::string nearest_in(const CLI::App& app, const std::string& typed) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    if (!option->get_group().empty()) names.push_back(option->get_name());
  for (const CLI::App* command : app.get_subcommands(nullptr)) names.push_back(command->get_name());
  return nearest_name(typed, names);
}

// Returns the end of a message: the name that the user typed, and the most similar known name.
std::string found_name(const CLI::App& app, const std::string& typed) {
  const std::string nearest = nearest_in(app, typed);
  return cat("found '", on_one_line(typed), "'", nearest.empty() ? "" : cat(", the nearest is ", nearest));
}

// Returns the first option that CLI11 does not know. If there is none, returns the first unexpected word
// without dashes.
std::string first_unknown(const CLI::App& app) {
  const std::vector<std::string> words = app.remaining();
  const auto option = std::ranges::find_if(words, [](const auto& word) { return word.starts_with('-'); });
  return words.empty() ? std::string() : option != words.end() ? *option : words.front();
}

std::string words_of(const CLI::Error& error, const CLI::App& app) {
  const std::string text = error.what();
  const auto between = [&](std::string_view before, std::string_view after) {
    const std::size_t begin = text.find(before) + before.size();
    return text.substr(begin, text.find(after, begin) - begin);
  };
  const std::string flag = text.substr(0, text.find(':'));
  if (text.contains(" not in range "))
    return cat(flag, ": expected a number from ", between(" in range ", "\n"), ", found ",
               between(": Value ", " "));
  if (text.starts_with("Could not convert: "))
    return cat(between("convert: ", " ="), ": expected a number, found '", between(" = ", "\n"), "'");
  if (const std::string unknown = first_unknown(app); !unknown.empty())
    return cat("expected only known options, ", found_name(app, unknown));
  if (text.contains(": At Most 1 required but received "))
    return cat(flag, ": expected it once, found it ", between("received ", "\n"), " times");
  if (text.contains(" required ") && text.ends_with(" missing"))
    return cat(flag, ": expected a value, found none");
  if (text == "A subcommand is required") return "expected a command such as make, found none";
  if (text.ends_with(" is required")) return cat("expected ", between("", " is required"), ", found none");
  return text;
}

void add_commands(CLI::App& program, Result<void>& result) {
  program.set_version_flag("--version", std::string("relievo ") + version);
  program.require_subcommand(1);
  program.failure_message([](const CLI::App* app, const CLI::Error& error) {
    const auto commands = app->get_subcommands();  // the subcommands that the user typed
    const std::string command = commands.empty() ? "" : commands.front()->get_name() + " ";
    return words_of(error, commands.empty() ? *app : *commands.front()) + "; see relievo " + command +
           "--help";
  });
  add_make(program, result);
  add_info(program, result);
  add_sample(program, result);
  add_bench(program, result);
  add_studio(program, result);
  add_compare(program, result);
  add_batch(program, result);
  add_thumbnail(program, result);
  add_options(program, result);
  program.footer(
      "Examples:\n"
      "  relievo sample shell -o shell.ply\n"
      "  relievo make shell.ply -o shell.stl --width 80 --height 4 --preview shell.png\n"
      "  relievo info scan.ply\n"
      "  relievo batch scans -o reliefs --width 80 --height 4");
}

// Parses the arguments. CLI11 also runs the chosen command while it parses.
ProgramEnd parse(CLI::App& program, std::vector<std::string> arguments) {
  try {
    std::ranges::reverse(arguments);  // CLI11 expects the last argument first
    program.parse(std::move(arguments));
  } catch (const CLI::ParseError& error) {
    std::ostringstream message;
    if (program.exit(error, std::cout, message) == 0) return {};
    return {2, message.str()};
  } catch (const std::bad_alloc&) {
    return {1, "expected more free memory for so many points", true};
  } catch (const std::system_error& error) {
    if (error.code() != std::errc::resource_unavailable_try_again) throw;
    return {1, "expected more threads than the system gives; ulimit -u and ulimit -v limit them", true};
  }
  return {};
}

}  // namespace

ProgramEnd run_program(std::vector<std::string> arguments) {
  CLI::App program{"Relievo turns a 3D scan into a bas-relief.", "relievo"};
  Result<void> result;
  add_commands(program, result);
  const std::string first = arguments.empty() ? "" : arguments[0];
  const auto is_asked_for = [&](const CLI::App* command) { return command->get_name() == first; };
  if (!first.empty() && first[0] != '-' && program.get_subcommands(is_asked_for).empty())
    return {2, cat("expected make, studio, info, sample, batch, bench or compare, ",
                   found_name(program, first), "; see relievo --help")};
  const ProgramEnd end = parse(program, std::move(arguments));
  if (end.exit_code != 0 || result) return end;
  const ErrorKind kind = result.error().kind;
  return {kind == ErrorKind::option ? 2 : 1, on_one_line(line_of(result.error(), program)),
          kind == ErrorKind::output};
}

}  // namespace relievo::app::cli
