// Reads and writes one connection, with time limits. Tested by apps/studio/tests/server.test.mjs.
#pragma once

// This header comes first, because the server's header defines a macro _res that breaks Eigen.
#include "relievo/core/types.h"

#include <httplib.h>

#include <string>

namespace relievo::app::studio {

// Reads from a socket, which it does not own, after the bytes that were received from it before. Reading
// returns 0 at the end of the connection, and -1 for errors and after waiting too long.
class BufferedStream : public httplib::Stream {
 public:
  BufferedStream(int socket, std::string received) : socket_(socket), received_(std::move(received)) {}

  // Returns the number of bytes that were read from this stream.
  std::uint64_t bytes_read() const { return bytes_read_; }

  // Returns the bytes that were received but not read.
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
