// Serves HTTP on 127.0.0.1, with limits that httplib lacks. Tested by apps/studio/tests/server.test.mjs.
#pragma once

#include <memory>
#include <optional>

#include "studio/buffered_stream.h"

namespace relievo::app::studio {

// An httplib::Server that manages its connections itself. No other program can share its port. If the body of a
// request was not read to its end, the connection is closed after the answer.
class HttpServer : public httplib::Server {
 public:
  HttpServer();
  ~HttpServer() override;

  // Opens the port, or any free port if `port` is 0. Returns the opened port; nothing if the port is taken.
  std::optional<int> bind(int port);

  // Answers requests until stop() is called.
  void run();

 private:
  struct Connections;

  bool process_and_close_socket(int socket) override;
  bool answer(BufferedStream& stream);

  std::unique_ptr<Connections> connections_;
};

}  // namespace relievo::app::studio
