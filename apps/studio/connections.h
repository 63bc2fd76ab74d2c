// Manages the connections of the studio's server. A thread is given to a request only when its head has
// arrived, so that slow or silent connections occupy no thread. Tested by apps/studio/tests/server.test.mjs.
#pragma once

#include <functional>
#include <memory>

#include "studio/buffered_stream.h"

namespace relievo::app::studio {

// Takes sockets, waits for the heads of their requests, and has each request answered in one of its threads.
// A head has limits of size and time; if there are too many sockets, the longest waiting one is closed.
class Connections {
 public:
  // Answers one request. Returns whether the connection may send another.
  using Answer = std::function<bool(BufferedStream&)>;

  // Starts a few threads, and more when they are needed. Throws std::system_error if the system does not even
  // allow these few.
  explicit Connections(Answer answer);
  ~Connections();  // see stop()

  // Owns the socket from now on. Waits while all connections are busy with requests.
  void take(int socket);

  // Closes the waiting connections, and returns when all running requests have been answered.
  void stop();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace relievo::app::studio
