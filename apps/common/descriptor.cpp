#include "common/descriptor.h"

#include <cerrno>
#include <cstring>

namespace relievo::app {

std::unexpected<Error> system_error(ErrorKind kind, const std::string& path, const std::string& expected) {
  return std::unexpected(Error{kind, path, {}, expected + ": " + std::strerror(errno)});
}

bool write_all(int descriptor, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return true;
}

}  // namespace relievo::app
