// Reads and writes one connection, with time limits. Tested by apps/studio/tests/server.test.mjs.
#pragma once

// This header must be included first, because the server's header defines a macro _res that breaks Eigen.
#include "relievo/core/types.h"

#include <httplib.h>

#include <string>

namespace relievo::app::studio {

// A stream that first returns the bytes that were received earlier, and then reads from a socket. It does not
// own the socket. A read returns 0 at the end of the connection, and -1 after an error or after the time
// limit.
class BufferedStream : public httplib::Stream {
 public:
  BufferedStream(int socket, std::string received) : socket_(socket), received_(std::move(received)) {}

  // Returns the number of bytes that were read from this stream.
  std::uint64_t bytes_read() const { return bytes_read_; }

  // Returns the received bytes that no reader has taken yet.
  std::string unread() const { return received_.substr(position_); }

  bool is_readable() const override;
  bool is_writable() const override;
  ssize_t read(char* to, std::size_t size) override;
  ssize_t write(const char* from, std::size_t size) override;
  void get_remote_ip_and_port(std::string& ip, int& port) const override;
  void get_local_ip_and_port(std::string& ip, int& port) const override;
  int socket() const override { return socket_; }

 private:
  ssize_t receive();

  int socket_;
  std::string received_;
  std::size_t position_ = 0;
  std::uint64_t bytes_read_ = 0;
};

}  // namespace relievo::app::studio
