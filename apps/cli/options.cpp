#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/command_table.h"
#include "cli/commands.h"
#include "common/files.h"
#include "common/option_list.h"
#include "common/output_files.h"
#include "relievo/core/text.h"

namespace relievo::app::cli {
namespace {

struct OptionsArguments {
  bool is_markdown = false, is_json = false;
  std::string man, completion, folder;
};

Result<std::string> man_page(const std::vector<CommandInfo>& commands, const std::string& name) {
  if (name == "relievo") return program_man_page(commands);
  const auto command = std::ranges::find(commands, name, &CommandInfo::name);
  if (command == commands.end())
    return option_error("man", cat("expected relievo or a command, found '", name, "'"));
  return command_man_page(*command);
}

// Writes the man pages and the completion scripts to their standard places below `folder`, the share/ of an
// installation.
Result<void> write_share(const std::vector<CommandInfo>& commands, const std::string& folder) {
  std::vector<std::pair<std::string, std::string>> files{
      {"man/man1/relievo.1", program_man_page(commands)},
      {"bash-completion/completions/relievo", completion_script(commands, "bash")},
      {"zsh/vendor-completions/_relievo", completion_script(commands, "zsh")},
      {"fish/vendor_completions.d/relievo.fish", completion_script(commands, "fish")}};
  for (const CommandInfo& command : commands)
    files.emplace_back(cat("man/man1/relievo-", command.name, ".1"), command_man_page(command));
  for (const auto& [name, text] : files) {
    const std::filesystem::path path = std::filesystem::path(folder) / name;
    std::error_code error;
    std::filesystem::create_directories(path.parent_path(), error);
    if (error) return std::unexpected(Error{ErrorKind::output, path.string(), {}, error.message()});
    const OutputFile file{path.string(), bytes_of(text)};
    RELIEVO_CHECK(write_files({&file, 1}));
  }
  return {};
}

Result<void> print(const OptionsArguments& arguments, const CLI::App& program) {
  const std::vector<CommandInfo> commands = command_table(program);
  if (!arguments.folder.empty()) return write_share(commands, arguments.folder);
  std::string text = arguments.is_json ? option_list().dump(1) + "\n" : option_markdown();
  if (!arguments.man.empty()) {
    RELIEVO_TRY(text, man_page(commands, arguments.man));
  } else if (!arguments.completion.empty()) {
    text = completion_script(commands, arguments.completion);
    if (text.empty())
      return option_error("completion",
                          cat("expected bash, zsh or fish, found '", arguments.completion, "'"));
  }
  std::fputs(text.c_str(), stdout);
  return {};
}

}  // namespace

// Adds the command `options`. The help does not show this command, because it is for making documents, pages
// and packages.
void add_options(CLI::App& program, Result<void>& result) {
  const auto arguments = std::make_shared<OptionsArguments>();
  CLI::App& command = *program.add_subcommand("options", "Print the table of make's options")->group("");
  command.add_flag("--markdown", arguments->is_markdown, "as docs/options.md has it; so without a flag");
  command.add_option("--man", arguments->man, "man page of relievo or of a command")->type_name("COMMAND");
  command.add_flag("--json", arguments->is_json, "as the studio's page reads it");
  command.add_option("--completion", arguments->completion, "completion script of bash, zsh or fish")
      ->type_name("SHELL");
  command.add_option("--share", arguments->folder, "write all man pages and completion scripts below it")
      ->type_name("DIR");
  command.callback([arguments, &program, &result] { result = print(*arguments, program); });
}

}  // namespace relievo::app::cli
