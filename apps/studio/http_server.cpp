#include "studio/http_server.h"

#include <sys/socket.h>

namespace relievo::app::studio {
namespace {

using httplib::Request;

// Runs each task at once in the thread that accepts connections. A task only passes its connection to
// Connections, which has its own threads.
class DirectQueue : public httplib::TaskQueue {
 public:
  void enqueue(std::function<void()> task) override { task(); }
  void shutdown() override {}
};

std::optional<std::uint64_t> announced_body(const Request& request) {
  if (request.has_header("Transfer-Encoding")) return std::nullopt;
  if (!request.has_header("Content-Length")) return 0;
  return request.get_header_value<std::uint64_t>("Content-Length");
}

}  // namespace

HttpServer::HttpServer() : connections_([this](BufferedStream& stream) { return answer(stream); }) {
  new_task_queue = [] { return new DirectQueue; };
  // With the default options of httplib, another program of the same user could open the same port, receive
  // some of the connections, and read the token in them.
  set_socket_options([](int socket) {
    const int yes = 1;
    ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
}

std::optional<int> HttpServer::bind(int port) {
  const std::string host = "127.0.0.1";
  if (port == 0)
    port = bind_to_any_port(host);
  else if (!bind_to_port(host, port))
    port = -1;
  if (port <= 0) return std::nullopt;
  ::listen(svr_sock_, 1024);  // httplib itself accepts only 5 pending connections
  return port;
}

void HttpServer::run() {
  listen_after_bind();
  connections_.stop();
}

bool HttpServer::process_and_close_socket(int socket) {
  connections_.take(socket);
  return true;
}

bool HttpServer::answer(BufferedStream& stream) {
  const std::uint64_t head = stream.unread().find("\r\n\r\n") + 4;
  std::optional<std::uint64_t> body;
  bool is_last = false;
  const bool is_answered =
      process_request(stream, false, is_last, [&](Request& request) { body = announced_body(request); });
  return is_answered && !is_last && body && stream.bytes_read() == head + *body;
}

}  // namespace relievo::app::studio
