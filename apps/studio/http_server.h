// HTTP on 127.0.0.1 with limits that the library behind it lacks. Tested by apps/studio/tests/server.test.mjs.
#pragma once

#include <optional>

#include "studio/connections.h"

namespace relievo::app::studio {

// Handlers are set as for httplib::Server, but connections are those of Connections, and no other program can share the
// port. A connection is closed after a request whose body was not read to its end.
class HttpServer : public httplib::Server {
 public:
  HttpServer();

  // Opens the port, or a free one for 0. Returns it; nothing if it is taken.
  std::optional<int> bind(int port);

  // Answers until stop() is called.
  void run();

 private:
  bool process_and_close_socket(int socket) override;
  bool answer(BufferedStream& stream);

  Connections connections_;
};

}  // namespace relievo::app::studio
