#include "common/files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cctype>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <list>
#include <utility>

#include "relievo/core/choice.h"
#include "relievo/core/text.h"

namespace relievo::app {
namespace {

std::unexpected<Error> system_error(ErrorKind kind, const std::string& path, const std::string& expected) {
  return std::unexpected(Error{kind, path, {}, expected + ": " + std::strerror(errno)});
}

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

bool write_all(int descriptor, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return true;
}

// The mode that a plain open() for writing would have given.
mode_t new_file_mode() {
  const mode_t mask = ::umask(0);
  ::umask(mask);
  return 0666 & ~mask;
}

// A temporary file's name where a signal handler may read it at any time.
struct TemporaryName {
  std::atomic<bool> is_used = false;
  char text[PATH_MAX] = {};
};
std::array<TemporaryName, 8> temporary_names;

extern "C" void remove_temporaries(int signal) {
  for (const TemporaryName& name : temporary_names)
    if (name.is_used) ::unlink(name.text);
  ::raise(signal);  // now with its usual effect
}

// A file beside `path` that takes its place when kept, and is gone otherwise.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& path) : path_(path) {
    const auto free = std::find_if(temporary_names.begin(), temporary_names.end(),
                                   [](const TemporaryName& name) { return !name.is_used; });
    const std::string pattern = path + ".XXXXXX";
    if (free == temporary_names.end() || pattern.size() >= sizeof free->text) {
      errno = free == temporary_names.end() ? EMFILE : ENAMETOOLONG;
      return;
    }
    name_ = &*free;
    std::copy_n(pattern.c_str(), pattern.size() + 1, name_->text);
    name_->is_used = true;
    file_ = Descriptor(::mkstemp(name_->text));
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    if (!name_) return;
    if (!is_kept_) ::unlink(name_->text);
    name_->is_used = false;
  }

  Result<void> write(std::span<const std::byte> bytes) {
    if (!file_.is_open())
      return system_error(ErrorKind::output, path_, "expected a place that can be written to");
    const bool is_written = write_all(file_.number(), bytes) &&
                            ::fchmod(file_.number(), new_file_mode()) == 0 && ::fsync(file_.number()) == 0 &&
                            file_.close();
    if (is_written) return {};
    return system_error(ErrorKind::output, path_, "expected room to write the file");
  }

  Result<void> keep() {
    is_kept_ = ::rename(name_->text, path_.c_str()) == 0;
    if (is_kept_) return {};
    return system_error(ErrorKind::output, path_, "expected a file that can be replaced");
  }

 private:
  const std::string& path_;
  TemporaryName* name_ = nullptr;
  Descriptor file_{-1};
  bool is_kept_ = false;
};

std::string folder_of(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  return folder.empty() ? "." : folder.string();
}

// Returns whether both paths lead to the same file, which need not exist.
bool is_same_file(const std::string& a, const std::string& b) {
  std::error_code ignored;
  if (std::filesystem::equivalent(a, b, ignored)) return true;
  const auto full = [](const std::string& path) {
    std::error_code none;
    return std::filesystem::weakly_canonical(std::filesystem::absolute(path, none), none);
  };
  return full(a) == full(b);
}

Result<void> check_writable(const std::string& path) {
  std::error_code ignored;
  const std::string folder = folder_of(path);
  if (std::filesystem::is_directory(path, ignored))
    return std::unexpected(Error{ErrorKind::output, path, {}, "expected a file name, found a folder"});
  if (std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored))
    return std::unexpected(Error{ErrorKind::output, path, {}, "expected a file, found a device or a pipe"});
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    return system_error(ErrorKind::output, path,
                        "expected a folder that can be written to, '" + folder + "'");
  return {};
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
  // One more than the size, so that the end is seen without growing; pipes have no size.
  std::vector<std::byte> bytes(static_cast<std::size_t>(std::max<off_t>(status.st_size + 1, 1 << 16)));
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

Result<void> check_output(const std::string& path, const std::vector<std::string_view>& endings,
                          std::span<const std::string> taken) {
  if (!endings.empty() && std::ranges::find(endings, cat(".", ending_of(path))) == endings.end())
    return option_error(path, cat("expected a file ending in ", either(endings)));
  if (std::ranges::any_of(taken, [&](const std::string& other) { return is_same_file(path, other); }))
    return option_error(path, "expected different files for input and outputs");
  return check_writable(path);
}

Result<void> write_files(std::span<const OutputFile> files) {
  std::list<TemporaryFile> temporaries;
  for (const OutputFile& file : files)
    if (auto ok = temporaries.emplace_back(file.path).write(file.bytes); !ok) return ok;
  for (TemporaryFile& temporary : temporaries)
    if (auto ok = temporary.keep(); !ok) return ok;
  return {};
}

void remove_temporary_files_on_signals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXFSZ}) {
    struct sigaction action {};
    ::sigaction(signal, nullptr, &action);
    if (action.sa_handler == SIG_IGN) continue;
    action.sa_handler = remove_temporaries;
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    ::sigaction(signal, &action, nullptr);
  }
}

std::vector<std::byte> bytes_of(std::string_view text) {
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

std::string ending_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  if (!ending.empty()) ending.erase(0, 1);
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

}  // namespace relievo::app
