#include "common/descriptor.h"

#include <cerrno>
#include <cstring>

namespace relievo::app {

std::unexpected<Error> system_error(ErrorKind kind, const std::string& path, const std::string& expected) {
  return std::unexpected(Error{kind, path, {}, expected + ": " + std::strerror(errno)});
}

}  // namespace relievo::app
