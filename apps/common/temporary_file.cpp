#include "common/temporary_file.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstring>

namespace relievo::app {

// A temporary file's name where a signal handler may read it at any time.
struct TemporaryName {
  std::atomic<bool> is_used = false;
  char text[PATH_MAX] = {};
};

namespace {

std::array<TemporaryName, 8> temporary_names;

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

extern "C" void remove_temporaries(int signal) {
  for (const TemporaryName& name : temporary_names)
    if (name.is_used) ::unlink(name.text);
  ::raise(signal);  // now with its usual effect
}

// Takes a name that is free; null if there is none.
TemporaryName* take_name() {
  for (TemporaryName& name : temporary_names)
    if (bool is_used = false; name.is_used.compare_exchange_strong(is_used, true)) return &name;
  return nullptr;
}

}  // namespace

std::unexpected<Error> system_error(ErrorKind kind, const std::string& path, const std::string& expected) {
  return std::unexpected(Error{kind, path, {}, expected + ": " + std::strerror(errno)});
}

TemporaryFile::TemporaryFile(const std::string& path) : path_(path) {
  const std::string pattern = path + ".XXXXXX";
  errno = ENAMETOOLONG;
  if (pattern.size() >= sizeof TemporaryName::text) return;
  errno = EMFILE;
  name_ = take_name();
  if (!name_) return;
  std::copy_n(pattern.c_str(), pattern.size() + 1, name_->text);
  file_ = Descriptor(::mkstemp(name_->text));
}

TemporaryFile::~TemporaryFile() {
  if (!name_) return;
  if (!is_kept_) ::unlink(name_->text);
  name_->is_used = false;
}

Result<void> TemporaryFile::append(std::span<const std::byte> bytes) {
  if (!file_.is_open())
    return system_error(ErrorKind::output, path_, "expected a place that can be written to");
  if (write_all(file_.number(), bytes)) return {};
  return system_error(ErrorKind::output, path_, "expected room to write the file");
}

Result<void> TemporaryFile::finish() {
  const bool is_written =
      ::fchmod(file_.number(), new_file_mode()) == 0 && ::fsync(file_.number()) == 0 && file_.close();
  if (is_written) return {};
  return system_error(ErrorKind::output, path_, "expected room to write the file");
}

Result<void> TemporaryFile::keep(const std::string& path) {
  is_kept_ = ::rename(name_->text, path.c_str()) == 0;
  if (is_kept_) return {};
  return system_error(ErrorKind::output, path, "expected a file that can be replaced");
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

}  // namespace relievo::app
