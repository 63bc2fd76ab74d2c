#include "files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <utility>

namespace relievo::cli {
namespace {

std::unexpected<Error> system_error(ErrorKind kind, const std::string& path, const std::string& expected) {
  return std::unexpected(Error{kind, path, {}, expected + ": " + std::strerror(errno)});
}

// Closes a file descriptor at the end of its scope.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
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

bool write_all(int descriptor, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return true;
}

std::string folder_of(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  return folder.empty() ? "." : folder.string();
}

// The mode that a plain open() for writing would have given.
mode_t new_file_mode() {
  const mode_t mask = ::umask(0);
  ::umask(mask);
  return 0666 & ~mask;
}

}  // namespace

Result<std::vector<std::byte>> read_file(const std::string& path) {
  Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file.is_open()) return system_error(ErrorKind::input, path, "expected a file that can be read");
  struct stat status {};
  if (::fstat(file.number(), &status) != 0 || S_ISDIR(status.st_mode)) {
    errno = EISDIR;
    return system_error(ErrorKind::input, path, "expected a file");
  }
  std::vector<std::byte> bytes(static_cast<std::size_t>(std::max<off_t>(status.st_size, 1 << 16)));
  std::size_t filled = 0;
  for (;;) {
    if (filled == bytes.size()) bytes.resize(bytes.size() * 2);
    const ssize_t got = ::read(file.number(), bytes.data() + filled, bytes.size() - filled);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return system_error(ErrorKind::input, path, "expected a file that can be read");
    if (got == 0) break;
    filled += static_cast<std::size_t>(got);
  }
  bytes.resize(filled);
  return bytes;
}

Result<void> check_writable(const std::string& path) {
  std::error_code ignored;
  const std::string folder = folder_of(path);
  if (std::filesystem::is_directory(path, ignored))
    return std::unexpected(Error{ErrorKind::output, path, {}, "expected a file name, found a folder"});
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    return system_error(ErrorKind::output, path,
                        "expected a folder that can be written to, '" + folder + "'");
  return {};
}

Result<void> write_file(const std::string& path, std::span<const std::byte> bytes) {
  std::string temporary = path + ".XXXXXX";
  Descriptor file(::mkstemp(temporary.data()));
  if (!file.is_open())
    return system_error(ErrorKind::output, path, "expected a place that can be written to");
  const bool is_written = write_all(file.number(), bytes) && ::fchmod(file.number(), new_file_mode()) == 0 &&
                          ::fsync(file.number()) == 0 && file.close() &&
                          ::rename(temporary.c_str(), path.c_str()) == 0;
  if (is_written) return {};
  auto error = system_error(ErrorKind::output, path, "expected room to write the file");
  ::unlink(temporary.c_str());
  return error;
}

std::string ending_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  if (!ending.empty()) ending.erase(0, 1);
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

}  // namespace relievo::cli
