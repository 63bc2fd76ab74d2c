// The studio's web server: the page's files and the engines behind it, for this machine alone.
#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "studio/actions.h"
#include "studio/disk/disk_store.h"

namespace relievo::app::studio {

struct ServerOptions {
  int port = 0;  // 0 takes that of the last run, or if it is taken a free one
  std::string
      page_folder;  // where page files are read from instead of the program itself; for work on the page
  std::chrono::seconds linger{15};  // how long to go on when the last page has gone
};

// Answers on 127.0.0.1 only, and only requests whose path begins with a token that nobody else knows, that
// were sent to this machine by name, and that no other web site sent.
class Server {
 public:
  Server(Actions& actions, const DiskStore& store, const ServerOptions& options);
  ~Server();

  // Opens the port and returns the page's address. Errors: kind option if the port is taken.
  Result<std::string> bind();

  // Answers until the last page has gone for good. Before a first page came, it waits for one.
  void run();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace relievo::app::studio
