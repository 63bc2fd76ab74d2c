#include <cstdio>
#include <new>

#include "cli/commands.h"
#include "cli/terminal.h"
#include "common/temporary_file.h"
#include "relievo/core/version.h"

namespace {

// Returns the line to print; an option is named by its flag: "--height: expected ...".
std::string line_of(relievo::Error error, const CLI::App& program) {
  const std::string flag = "--" + error.input;
  for (const CLI::App* command : program.get_subcommands())
    if (command->get_option_no_throw(flag) != nullptr) error.input = flag;
  return error.message();
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App program{"Relievo turns a 3D scan into a bas-relief.", "relievo"};
  program.set_version_flag("--version", std::string("relievo ") + relievo::version);
  program.require_subcommand(1);
  program.failure_message([](const CLI::App* app, const CLI::Error& error) {
    const auto commands = app->get_subcommands();  // those that the user named
    const std::string command = commands.empty() ? "" : commands.front()->get_name() + " ";
    return std::string("relievo: ") + error.what() + "; see relievo " + command + "--help\n";
  });
  relievo::Result<void> result;
  relievo::app::cli::add_make(program, result);
  relievo::app::cli::add_info(program, result);
  relievo::app::cli::add_sample(program, result);
  relievo::app::cli::add_bench(program, result);
  relievo::app::cli::add_studio(program, result);
  relievo::app::cli::add_compare(program, result);
  relievo::app::cli::add_options(program, result);
  program.footer(
      "Examples:\n"
      "  relievo sample shell -o shell.ply\n"
      "  relievo make shell.ply -o shell.stl --width 80 --height 4 --preview shell.png\n"
      "  relievo info scan.ply");
  const auto is_asked_for = [&](const CLI::App* command) { return command->get_name() == argv[1]; };
  if (argc > 1 && argv[1][0] != '-' && program.get_subcommands(is_asked_for).empty()) {
    std::fprintf(
        stderr,
        "relievo: expected make, studio, info, sample, bench or compare, found '%s'; see relievo --help\n",
        relievo::app::cli::on_one_line(argv[1]).c_str());
    return 2;
  }
  relievo::app::remove_temporary_files_on_signals();
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? 0 : 2;
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "relievo: expected more free memory for so many points\n");
    return 1;
  }
  if (result) return 0;
  std::fprintf(stderr, "relievo: %s\n",
               relievo::app::cli::on_one_line(line_of(result.error(), program)).c_str());
  return result.error().kind == relievo::ErrorKind::option ? 2 : 1;
}
