#include <cstdio>
#include <new>

#include "commands.h"
#include "files.h"
#include "relievo/core/version.h"

int main(int argc, char** argv) {
  CLI::App program{"Relievo turns a 3D scan into a bas-relief.", "relievo"};
  program.set_version_flag("--version", std::string("relievo ") + relievo::version);
  program.require_subcommand(1);
  program.failure_message([](const CLI::App*, const CLI::Error& error) {
    return std::string("relievo: ") + error.what() + "; see relievo --help\n";
  });
  relievo::Result<void> result;
  relievo::cli::add_make(program, result);
  relievo::cli::add_info(program, result);
  relievo::cli::add_sample(program, result);
  relievo::cli::add_bench(program, result);
  relievo::cli::add_studio(program, result);
  relievo::cli::add_compare(program, result);
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
        argv[1]);
    return 2;
  }
  relievo::cli::remove_temporary_files_on_signals();
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? 0 : 2;
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "relievo: expected more free memory for so many points\n");
    return 1;
  }
  if (result) return 0;
  std::fprintf(stderr, "relievo: %s\n", result.error().message().c_str());
  return result.error().kind == relievo::ErrorKind::option ? 2 : 1;
}
