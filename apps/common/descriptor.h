// Wraps a file descriptor so that it is closed automatically, and turns errors of the system into messages.
// Tested by tests/cli/files_test.cpp.
#pragma once

#include <unistd.h>

#include <cstddef>
#include <span>
#include <string>
#include <utility>

#include "relievo/core/error.h"

namespace relievo::app {

// Returns an error whose message is `expected` and the system's text for errno.
std::unexpected<Error> system_error(ErrorKind kind, const std::string& path, const std::string& expected);

// Writes all bytes, even if signals interrupt the writing. Returns whether it succeeded; after a failure
// errno has the reason.
bool write_all(int descriptor, std::span<const std::byte> bytes);

// Closes a file descriptor at the end of its scope.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~Descriptor() { close(); }

  int number() const { return number_; }
  bool is_open() const { return number_ >= 0; }
  bool close() {
    const int closed = std::exchange(number_, -1);
    return closed < 0 || ::close(closed) == 0;
  }

 private:
  int number_;
};

}  // namespace relievo::app
