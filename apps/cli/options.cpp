#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "common/option_list.h"

namespace relievo::app::cli {
namespace {

struct Faces {
  bool is_markdown = false, is_man = false, is_json = false;
};

void print(const Faces& face) {
  const std::string text = face.is_json  ? option_list().dump(1) + "\n"
                           : face.is_man ? option_man_page()
                                         : option_markdown();
  std::fputs(text.c_str(), stdout);
}

}  // namespace

// Not in the help: for those who write documents and pages.
void add_options(CLI::App& program, Result<void>& result) {
  const auto face = std::make_shared<Faces>();
  CLI::App& command = *program.add_subcommand("options", "Print the table of make's options")->group("");
  command.add_flag("--markdown", face->is_markdown, "as the README has it; so without a flag");
  command.add_flag("--man", face->is_man, "as a man page");
  command.add_flag("--json", face->is_json, "as the studio's page reads it");
  command.callback([face, &result] {
    print(*face);
    result = {};
  });
}

}  // namespace relievo::app::cli
