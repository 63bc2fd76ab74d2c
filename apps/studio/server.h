// The studio's web server: serves the page's files, and answers the page's requests, only on this machine.
#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "studio/actions.h"
#include "studio/disk/disk_store.h"

namespace relievo::app::studio {

struct ServerOptions {
  int port = 0;  // 0: the port of the last run, or a free one if that is taken
  std::string
      page_folder;  // if given, page files are read from this folder, not the program; for work on the page
  std::chrono::seconds linger{15};  // how long to go on after the last page is closed
};

// Answers on 127.0.0.1 only. A request must have the secret token at the start of its path and name this
// machine as its host, and must not come from another web site.
class Server {
 public:
  Server(Actions& actions, const DiskStore& store, const ServerOptions& options);
  ~Server();

  // Opens the port and returns the page's address. Errors: kind option if the port is taken.
  Result<std::string> bind();

  // Answers until the last page has been closed for good. Waits for the first page.
  void run();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace relievo::app::studio
