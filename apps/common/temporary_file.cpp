#include "common/temporary_file.h"

#include <fcntl.h>
#include <sched.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstring>
#include <filesystem>

namespace relievo::app {

// A temporary file's name where a signal handler may read it at any time.
struct TemporaryName {
  std::atomic<bool> is_used = false;
  char text[PATH_MAX] = {};
};

namespace {

std::array<TemporaryName, 8> temporary_names;

constexpr std::array ending_signals = {SIGINT, SIGTERM, SIGHUP};

std::atomic<bool> is_ending = false;       // temporary files are being removed, and the process ends then
std::atomic<int> threads_with_change = 0;  // threads that make or rename a temporary file now
static_assert(decltype(is_ending)::is_always_lock_free && decltype(threads_with_change)::is_always_lock_free);

// While a thread has one, it may make or rename a temporary file. Without it a file could be made after a signal, which
// another thread handles, had removed all of them. If the process ends already, the thread goes no further.
class FileChange {
 public:
  FileChange() {
    sigset_t signals;
    ::sigemptyset(&signals);
    for (const int signal : ending_signals) ::sigaddset(&signals, signal);
    ::pthread_sigmask(SIG_BLOCK, &signals, &former_);  // else this thread's handler would wait for itself
    ++threads_with_change;
    if (!is_ending) return;
    --threads_with_change;
    for (;;) ::pause();
  }
  FileChange(const FileChange&) = delete;
  FileChange& operator=(const FileChange&) = delete;
  ~FileChange() {
    --threads_with_change;
    ::pthread_sigmask(SIG_SETMASK, &former_, nullptr);
  }

 private:
  sigset_t former_{};
};

// The mode that a plain open() for writing would have given.
mode_t new_file_mode() {
  const mode_t mask = ::umask(0);
  ::umask(mask);
  return 0666 & ~mask;
}

extern "C" void remove_temporaries(int signal) {
  remove_temporary_files();
  ::raise(signal);  // now with its usual effect
}

// Takes a name that is free; null if there is none.
TemporaryName* take_name() {
  for (TemporaryName& name : temporary_names)
    if (bool is_used = false; name.is_used.compare_exchange_strong(is_used, true)) return &name;
  return nullptr;
}

constexpr std::string_view pattern_end = "XXXXXX";

// Returns the names of temporary files for that path, without their last six characters. They are no longer than a file
// system takes, 255 bytes.
std::string stem_for(const std::string& path) {
  const std::filesystem::path whole = path;
  const std::string mark = ".relievo-";
  const std::size_t most = NAME_MAX - mark.size() - pattern_end.size();
  return (whole.parent_path() / (whole.filename().string().substr(0, most) + mark)).string();
}

// Removes what was left by a run that ended without warning, as by a loss of power. Files that another process is
// writing are locked by it.
void remove_abandoned(const std::string& stem) {
  const std::filesystem::path pattern = stem;
  const std::string begin = pattern.filename().string();
  std::error_code failed;
  const auto folder = pattern.parent_path().empty() ? "." : pattern.parent_path();
  for (std::filesystem::directory_iterator entry(folder, failed), end; !failed && entry != end;
       entry.increment(failed)) {
    const std::string name = entry->path().filename().string();
    if (!name.starts_with(begin) || name.size() != begin.size() + pattern_end.size()) continue;
    const Descriptor file(::open(entry->path().c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    if (file.is_open() && ::flock(file.number(), LOCK_EX | LOCK_NB) == 0) ::unlink(entry->path().c_str());
  }
}

// Makes the file and locks it. Where another process removed it before it was locked, another is made.
Descriptor make_locked(char* name, std::string_view stem) {
  for (int attempt = 0; attempt < 3; ++attempt) {
    std::copy(pattern_end.begin(), pattern_end.end(), name + stem.size());
    const FileChange change;
    Descriptor file(::mkostemp(name, O_CLOEXEC));
    struct stat status {};
    if (!file.is_open()) return file;
    ::flock(file.number(), LOCK_EX | LOCK_NB);  // file systems without locks work, too
    if (::fstat(file.number(), &status) != 0 || status.st_nlink > 0) return file;
  }
  return Descriptor(-1);
}

}  // namespace

TemporaryFile::TemporaryFile(const std::string& path) : path_(path) {
  const std::string stem = stem_for(path), pattern = stem + std::string(pattern_end);
  errno = ENAMETOOLONG;
  if (pattern.size() >= sizeof TemporaryName::text) return;
  remove_abandoned(stem);
  errno = EMFILE;
  name_ = take_name();
  if (!name_) return;
  std::copy_n(pattern.c_str(), pattern.size() + 1, name_->text);
  file_ = make_locked(name_->text, stem);
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

Result<void> TemporaryFile::finish(bool is_durable) {
  const bool is_written =
      ::fchmod(file_.number(), new_file_mode()) == 0 && (!is_durable || ::fsync(file_.number()) == 0);
  if (is_written) return {};
  return system_error(ErrorKind::output, path_, "expected room to write the file");
}

Result<void> TemporaryFile::keep(const std::string& path) {
  {
    const FileChange change;
    is_kept_ = ::rename(name_->text, path.c_str()) == 0;
  }
  if (is_kept_) return {};
  return system_error(ErrorKind::output, path, "expected a file that can be replaced");
}

void remove_temporary_files() {
  is_ending = true;
  while (threads_with_change > 0) ::sched_yield();
  for (const TemporaryName& name : temporary_names)
    if (name.is_used) ::unlink(name.text);
}

void remove_temporary_files_on_signals() {
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error like a full disk
  for (const int signal : ending_signals) {
    struct sigaction action {};
    ::sigaction(signal, nullptr, &action);
    if (action.sa_handler == SIG_IGN) continue;
    action.sa_handler = remove_temporaries;
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    ::sigaction(signal, &action, nullptr);
  }
}

}  // namespace relievo::app
