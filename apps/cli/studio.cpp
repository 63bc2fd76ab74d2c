#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <sstream>
#include <string>
#include <thread>

#include "cli/commands.h"
#include "cli/flags.h"
#include "common/files.h"
#include "relievo/core/text.h"
#include "studio/actions.h"
#include "studio/disk/disk_store.h"
#include "studio/server.h"

namespace relievo::app::cli {
namespace {

struct StudioArguments {
  std::string input, page, state;
  int port = 0, linger_s = 15;
  bool has_no_browser = false;
};

// Asks the desktop to open the page in a browser. Without a desktop the user has to open the printed address.
void show(const std::string& address) {
  if (!std::getenv("DISPLAY") && !std::getenv("WAYLAND_DISPLAY")) return;
  std::thread([command = "xdg-open '" + address + "' >/dev/null 2>&1"] {
    (void)!std::system(command.c_str());
  }).detach();
}

// Returns the ssh command that makes the address reachable from the user's own machine; "" if the user is not
// logged in by ssh. SSH_CONNECTION has the address and the port of the user's machine, followed by those of
// this machine.
std::string tunnel_command(const std::string& address) {
  std::istringstream connection(environment_variable("SSH_CONNECTION"));
  std::string word, host, host_port;
  if (!(connection >> word >> word >> host >> host_port)) return {};
  const std::string port = address.substr(17, address.find('/', 17) - 17);  // after "http://127.0.0.1:"
  const std::string user = environment_variable("USER").empty() ? "" : environment_variable("USER") + "@";
  return cat("ssh -N -L ", port, ":127.0.0.1:", port, host_port == "22" ? "" : cat(" -p ", host_port), " ",
             user, host);
}

Result<void> studio(const StudioArguments& arguments) {
  RELIEVO_TRY(studio::StateFolder folder, studio::take_state_folder(arguments.state));
  const std::string detail = folder.detail;
  studio::DiskStore store(std::move(folder));
  studio::OpenDocuments documents;
  studio::Actions actions(documents, store);
  if (!arguments.input.empty())
    RELIEVO_CHECK(actions.begin_with(arguments.input, std::filesystem::absolute(arguments.input).string()));
  studio::Server server(actions, store,
                        {arguments.port, arguments.page, std::chrono::seconds(arguments.linger_s)});
  RELIEVO_TRY(const std::string address, server.bind());
  std::printf("Relievo studio: %s\nCtrl-C ends it; so does closing the page.\n", address.c_str());
  if (const std::string tunnel = tunnel_command(address); !tunnel.empty())
    std::printf("From the machine that you sit at, make a tunnel, then open the address there:\n  %s\n",
                tunnel.c_str());
  std::fflush(stdout);
  if (!detail.empty()) std::fprintf(stderr, "relievo: %s %s\n", store.notice().c_str(), detail.c_str());
  if (!arguments.has_no_browser) show(address);
  server.run();
  return {};
}

}  // namespace

void add_studio(CLI::App& program, Result<void>& result) {
  const auto arguments = std::make_shared<StudioArguments>();
  CLI::App& command = *program.add_subcommand("studio", "Shape a relief by hand, live, in the browser");
  command
      .add_option("input", arguments->input, "point cloud, mesh, depth image, scene or project, as for make")
      ->type_name("INPUT");
  add_number(command, "--port", arguments->port, CLI::Range(0, 65535), "0 for a free one [0 to 65535]");
  command.add_flag("--no-browser", arguments->has_no_browser, "print the address only");
  command.add_option("--state", arguments->state, "folder for what is kept between runs")->type_name("DIR");
  command
      .add_option("--linger", arguments->linger_s, "seconds to go on after the page has gone [0 to 86400]")
      ->check(CLI::Range(0, 86400).description(""))
      ->type_name("S")
      ->capture_default_str();
  command.add_option("--page", arguments->page, "read the page's files from a folder, to work on them")
      ->type_name("DIR");
  command.callback([arguments, &result] { result = studio(*arguments); });
}

}  // namespace relievo::app::cli
