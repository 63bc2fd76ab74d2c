#include "studio/http_server.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <list>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>
#include <vector>

#include "common/memory_reserve.h"

namespace relievo::app::studio {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using httplib::Request;

// The largest number of connections: half of 1024, the usual limit of a program's open files.
constexpr std::size_t most_connections = 512;
// The least and the largest number of threads that answer requests. Each page keeps one request for events
// open all the time, and slow uploads take long. So a few threads are not enough for several pages.
constexpr std::size_t fewest_answering = 4, most_answering = 96;
constexpr std::size_t most_head = 16U << 10;  // bytes; browsers send less than 2 KiB
constexpr auto longest_head = 5s;             // time from the first byte of a head to its last
constexpr auto longest_rest = 30s;            // time between two requests on a connection
constexpr auto longest_farewell = 2s;         // time in which a refused sender can read the answer
constexpr auto shortest_wait = 1s;            // a connection that waits longer may be closed to admit another

// A connection that no thread is answering.
struct Connection {
  int socket;
  std::string received;    // bytes of the next request, as far as they have arrived
  Clock::time_point last;  // time at which to close the connection
  bool is_ending = false;  // the answer was sent, and further bytes are discarded
  Clock::time_point since = Clock::now();
};

bool has_whole_head(const Connection& connection) {
  return connection.received.find("\r\n\r\n") != std::string::npos;
}

// Stops sending on a socket, but does not close it yet. If the other side is still sending, closing the
// socket would discard the answer before it is read.
Connection ending(int socket) {
  ::shutdown(socket, SHUT_WR);
  return {socket, {}, Clock::now() + longest_farewell, true};
}

enum class Arrival { partial, whole, over };

Arrival receive(Connection& connection) {
  std::array<char, 1U << 14> bytes;
  const ssize_t got = ::recv(connection.socket, bytes.data(), bytes.size(), MSG_DONTWAIT);
  if (got < 0 && (errno == EAGAIN || errno == EINTR)) return Arrival::partial;
  if (got <= 0) return Arrival::over;
  if (connection.is_ending) return Arrival::partial;
  if (connection.received.empty()) connection.last = Clock::now() + longest_head;
  connection.received.append(bytes.data(), static_cast<std::size_t>(got));
  if (has_whole_head(connection)) return Arrival::whole;
  if (connection.received.size() < most_head) return Arrival::partial;
  constexpr std::string_view refusal =
      "HTTP/1.1 431 Request Header Fields Too Large\r\nConnection: close\r\nContent-Length: 0\r\n\r\n";
  (void)!::send(connection.socket, refusal.data(), refusal.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
  connection = ending(connection.socket);
  return Arrival::partial;
}

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

// Manages the connections of the server. A request gets a thread only when its head has arrived, so that slow or
// silent connections block no thread. Heads have limits of size and time. If there are too many sockets, the one
// that has waited longest is closed.
struct HttpServer::Connections {
  // Answers one request. Returns whether the connection may send another request.
  using Answer = std::function<bool(BufferedStream&)>;

  Answer answer;
  int wake = ::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
  std::mutex mutex;  // guards the members below
  std::condition_variable has_request, has_room;
  std::list<Connection> waiting;  // in the order of their waiting time, longest first
  std::deque<Connection> ready;
  std::size_t open = 0;  // number of connections that are waiting, ready or being answered
  std::size_t idle = 0;  // number of threads that wait for a request
  bool is_stopping = false;
  std::vector<std::thread> threads;  // declared last, as the threads use the members above

  // Starts a few threads, and later starts more when all are busy. Throws std::system_error if the system
  // refuses one of the first threads.
  explicit Connections(Answer how) : answer(std::move(how)) {
    threads.reserve(1 + most_answering);
    try {
      threads.emplace_back([this] { wait_for_heads(); });
      for (std::size_t i = 0; i < fewest_answering; ++i) threads.emplace_back([this] { answer_requests(); });
    } catch (const std::system_error&) {
      stop();
      throw;
    }
  }

  ~Connections() {
    stop();
    ::close(wake);
  }

  // Starts another thread if all are busy. If the system refuses a thread, the existing ones continue. The
  // caller has locked `mutex`.
  void add_thread_if_needed() {
    if (is_stopping || ready.size() <= idle || threads.size() > most_answering) return;
    try {
      threads.emplace_back([this] { answer_requests(); });
    } catch (const std::system_error&) {
    } catch (const std::bad_alloc&) {
    }
  }

  void interrupt_waiting() const { (void)!::eventfd_write(wake, 1); }

  // The caller has locked `mutex`.
  void close(int socket) {
    ::close(socket);
    --open;
    has_room.notify_one();
  }

  // The caller has locked `mutex`.
  void drop(std::list<Connection>::iterator at) {
    close(at->socket);
    waiting.erase(at);
  }

  // Takes ownership of the socket. If there are too many connections, waits until one ends, or closes one
  // that has waited too long.
  void take(int socket) {
    std::unique_lock lock(mutex);
    while (open >= most_connections && !is_stopping) {
      if (!waiting.empty() && Clock::now() - waiting.front().since > shortest_wait)
        drop(waiting.begin());
      else
        has_room.wait_for(lock, shortest_wait / 4);
    }
    ++open;
    if (is_stopping) return close(socket);
    if (!wait_for_head({socket, {}, Clock::now() + longest_head})) close(socket);
  }

  // Adds the connection to `waiting`. Returns false if there is no memory for it. The caller has locked
  // `mutex`.
  bool wait_for_head(Connection connection) {
    try {
      waiting.push_back(std::move(connection));
    } catch (const std::bad_alloc&) {
      return false;
    }
    interrupt_waiting();
    return true;
  }

  // ---------------------------------------------------------------------------------- the thread that waits

  void wait_for_heads() {
    std::vector<pollfd> watched;
    watched.reserve(1 + most_connections);  // after this line the thread itself allocates nothing
    for (std::unique_lock lock(mutex); !is_stopping; lock.lock()) {
      watched.assign(1, {wake, POLLIN, 0});
      for (const Connection& connection : waiting) watched.push_back({connection.socket, POLLIN, 0});
      lock.unlock();
      ::poll(watched.data(), watched.size(), 250);
      eventfd_t count = 0;
      (void)!::eventfd_read(wake, &count);
      lock.lock();
      look_at(watched);
      lock.unlock();
    }
  }

  // Receives the bytes that have arrived on the watched connections, and closes connections that have ended
  // or waited too long. `watched` and `waiting` are in the same order, but after `watched` was filled,
  // connections may have been removed from the front of `waiting` and added to its end. The caller has locked
  // `mutex`.
  void look_at(const std::vector<pollfd>& watched) {
    const Clock::time_point now = Clock::now();
    auto found = watched.begin();
    for (auto at = waiting.begin(); at != waiting.end();) {
      const auto next = std::next(at);
      found = std::find_if(found, watched.end(), [&](const pollfd& each) { return each.fd == at->socket; });
      const bool has_news = found != watched.end() && found->revents != 0;
      if (has_news ? !take_in(at, now) : now > at->last) drop(at);
      at = next;
    }
  }

  // Receives the bytes that have arrived. Once the head of the request is complete, moves the connection to
  // `ready`. Returns false if the connection has ended or waited too long, or if there is no memory for it.
  // The caller has locked `mutex`.
  bool take_in(std::list<Connection>::iterator at, Clock::time_point now) {
    try {
      const Arrival arrival = receive(*at);
      if (arrival == Arrival::partial) return now <= at->last;
      if (arrival == Arrival::whole) make_ready(at);
      return arrival == Arrival::whole;
    } catch (const std::bad_alloc&) {
      return false;
    }
  }

  void make_ready(std::list<Connection>::iterator at) {
    ready.push_back(std::move(*at));
    waiting.erase(at);
    has_request.notify_one();
    add_thread_if_needed();
  }

  // ------------------------------------------------------------------------------------ the threads that answer

  void answer_requests() {
    std::unique_lock lock(mutex);
    for (;;) {
      ++idle;
      has_request.wait(lock, [this] { return is_stopping || !ready.empty(); });
      --idle;
      if (is_stopping) return;
      Connection connection = std::move(ready.front());
      ready.pop_front();
      lock.unlock();
      Connection answered = answer_on(std::move(connection));
      lock.lock();
      put_back(std::move(answered));
    }
  }

  // Answers the request that has arrived on a connection, and returns the connection for its next request. If
  // an error occurs after a part of the answer was sent, it can no longer be reported, and the connection
  // ends.
  Connection answer_on(Connection connection) {
    refill_memory_reserve();
    try {
      BufferedStream stream(connection.socket, std::move(connection.received));
      if (answer(stream)) return {connection.socket, stream.unread(), Clock::now() + longest_rest};
    } catch (const std::exception&) {
    }
    return ending(connection.socket);
  }

  // The caller has locked `mutex`.
  void put_back(Connection connection) {
    const int socket = connection.socket;
    if (is_stopping || !try_put_back(std::move(connection))) close(socket);
  }

  bool try_put_back(Connection connection) {
    if (connection.is_ending || !has_whole_head(connection)) return wait_for_head(std::move(connection));
    try {
      ready.push_back(std::move(connection));
    } catch (const std::bad_alloc&) {
      return false;
    }
    has_request.notify_one();
    return true;
  }

  // Closes the waiting connections, and returns after all running requests were answered.
  void stop() {
    {
      const std::lock_guard lock(mutex);
      is_stopping = true;
      has_request.notify_all();
      has_room.notify_all();
    }
    interrupt_waiting();
    for (std::thread& thread : threads) thread.join();
    threads.clear();
    for (const Connection& connection : waiting) ::close(connection.socket);
    for (const Connection& connection : ready) ::close(connection.socket);
    waiting.clear();
    ready.clear();
  }
};

HttpServer::HttpServer()
    : connections_(std::make_unique<Connections>([this](BufferedStream& stream) { return answer(stream); })) {
  new_task_queue = [] { return new DirectQueue; };
  // With the default options of httplib, another program of the same user could open the same port, receive
  // some of the connections, and read the token in them.
  set_socket_options([](int socket) {
    const int yes = 1;
    ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
}

HttpServer::~HttpServer() = default;

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
  connections_->stop();
}

bool HttpServer::process_and_close_socket(int socket) {
  connections_->take(socket);
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
