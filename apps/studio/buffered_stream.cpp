#include "studio/buffered_stream.h"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>

namespace relievo::app::studio {
namespace {

constexpr int most_wait_ms = 10000;  // time limit of one read or write; pages need only milliseconds
constexpr std::size_t piece =
    1U << 16;  // httplib asks for 4 KiB at a time, so large uploads would need many calls

bool wait_for(int socket, short event) {
  pollfd waited{socket, event, 0};
  int ready = 0;
  do ready = ::poll(&waited, 1, most_wait_ms);
  while (ready < 0 && errno == EINTR);
  return ready > 0;
}

}  // namespace

bool BufferedStream::is_readable() const {
  return position_ < received_.size() || wait_for(socket_, POLLIN);
}

bool BufferedStream::is_writable() const {
  return wait_for(socket_, POLLOUT);
}

ssize_t BufferedStream::receive() {
  if (!wait_for(socket_, POLLIN)) return -1;
  position_ = 0;
  received_.resize(piece);
  const ssize_t got = ::recv(socket_, received_.data(), piece, 0);
  received_.resize(static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
  return got;
}

ssize_t BufferedStream::read(char* to, std::size_t size) {
  if (position_ == received_.size())
    if (const ssize_t got = receive(); got <= 0) return got;
  const std::size_t taken = std::min(size, received_.size() - position_);
  std::copy_n(received_.data() + position_, taken, to);
  position_ += taken;
  bytes_read_ += taken;
  return static_cast<ssize_t>(taken);
}

ssize_t BufferedStream::write(const char* from, std::size_t size) {
  return wait_for(socket_, POLLOUT) ? ::send(socket_, from, size, MSG_NOSIGNAL) : -1;
}

// The server does not use addresses, since only this machine can connect to it.
void BufferedStream::get_remote_ip_and_port(std::string& ip, int& port) const {
  ip = "127.0.0.1";
  port = 0;
}

void BufferedStream::get_local_ip_and_port(std::string& ip, int& port) const {
  get_remote_ip_and_port(ip, port);
}

}  // namespace relievo::app::studio
