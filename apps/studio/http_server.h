// Serves HTTP on 127.0.0.1, with limits that httplib lacks. Tested by apps/studio/tests/server.test.mjs.
#pragma once

#include <optional>

#include "studio/connections.h"

namespace relievo::app::studio {

// An httplib::Server whose connections are managed by the class Connections. No other program can share its port. If
// a request's body was not read to its end, the connection is closed after the answer.
class HttpServer : public httplib::Server {
 public:
  HttpServer();

  // Opens the port, or any free port if `port` is 0. Returns the opened port; nothing if the port is taken.
  std::optional<int> bind(int port);

  // Answers requests until stop() is called.
  void run();

 private:
  bool process_and_close_socket(int socket) override;
  bool answer(BufferedStream& stream);

  Connections connections_;
};

}  // namespace relievo::app::studio
