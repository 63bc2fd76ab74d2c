// Serves the files of the studio's page and answers the page's requests, only on this machine.
#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "studio/actions.h"
#include "studio/disk/disk_store.h"

namespace relievo::app::studio {

struct ServerOptions {
  int port = 0;             // 0: the port of the last run, or any free port
  std::string page_folder;  // if given, the page is read from this folder, for people who work on the page
  std::chrono::seconds linger{15};  // time from the closing of the last page to the end of the server
};

// Serves only 127.0.0.1. The path of a request must begin with the secret token, its host must be this
// machine, and it must not come from another web site.
class Server {
 public:
  Server(Actions& actions, const DiskStore& store, const ServerOptions& options);
  ~Server();

  // Opens the port and returns the page's address. Errors: kind option if the port is taken.
  Result<std::string> bind();

  // Answers requests until no page has been open for ServerOptions::linger. Waits for the first page without limit.
  void run();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace relievo::app::studio
