// Manages the connections of the studio's server. A request gets a thread only when its head has arrived, so
// that slow or silent connections block no thread. Tested by apps/studio/tests/server.test.mjs.
#pragma once

#include <functional>
#include <memory>

#include "studio/buffered_stream.h"

namespace relievo::app::studio {

// Takes sockets, waits for the heads of their requests, and answers each request in one of its threads. Heads
// have limits of size and time. If there are too many sockets, the one that has waited longest is closed.
class Connections {
 public:
  // Answers one request. Returns whether the connection may send another request.
  using Answer = std::function<bool(BufferedStream&)>;

  // Starts a few threads, and later starts more when all are busy. Throws std::system_error if the system
  // refuses one of the first threads.
  explicit Connections(Answer answer);
  ~Connections();  // calls stop()

  // Takes ownership of the socket. If there are too many connections, waits until one ends, or closes one
  // that has waited too long.
  void take(int socket);

  // Closes the waiting connections, and returns after all running requests were answered.
  void stop();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace relievo::app::studio
