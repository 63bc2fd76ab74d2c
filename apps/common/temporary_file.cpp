#include "common/temporary_file.h"

#include <fcntl.h>
#include <sched.h>
#include <sys/file.h>
#include <sys/xattr.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <string_view>
#include <utility>

namespace relievo::app {

// The name of a temporary file. A signal handler may read the name at any time.
struct TemporaryName {
  // Makes a name from `stem` that this process has not used before. Returns whether the name fits into
  // `text`.
  bool renew(const std::string& stem) {
    static std::atomic<unsigned> count = 0;
    const int length =
        std::snprintf(text, sizeof text, "%s%d-%u", stem.c_str(), static_cast<int>(::getpid()), ++count);
    if (length < static_cast<int>(sizeof text)) return true;
    errno = ENAMETOOLONG;
    return false;
  }

  TemporaryName* next = nullptr;
  std::atomic<bool> is_used = false, is_there = false;  // is_there: this process has made the file
  char text[PATH_MAX] = {};
};

namespace {

// All names ever made, as a linked list. None is freed, since a signal handler may read it at any time.
std::atomic<TemporaryName*> temporary_names = nullptr;

constexpr std::array ending_signals = {SIGINT, SIGTERM, SIGHUP};

std::atomic<bool> is_ending = false;       // the process is removing its temporary files and will end
std::atomic<int> threads_with_change = 0;  // number of threads that make or rename a temporary file
static_assert(decltype(is_ending)::is_always_lock_free && decltype(threads_with_change)::is_always_lock_free);

// A thread must have a FileChange while it makes or renames a temporary file. Otherwise it could make a file
// after a signal handler in another thread has removed all of them. If the process is already ending, the
// constructor never returns.
class FileChange {
 public:
  FileChange() {
    sigset_t signals;
    ::sigemptyset(&signals);
    for (const int signal : ending_signals) ::sigaddset(&signals, signal);
    ::pthread_sigmask(SIG_BLOCK, &signals,
                      &former_);  // a handler in this thread would wait for this thread for ever
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

extern "C" void remove_temporaries(int signal) {
  remove_temporary_files();
  ::raise(signal);  // the default action of the signal now ends the process
}

// Reserves an unused name of the list, or adds a new one.
TemporaryName* take_name() {
  for (TemporaryName* name = temporary_names; name != nullptr; name = name->next)
    if (bool is_used = false; name->is_used.compare_exchange_strong(is_used, true)) return name;
  auto* const name = new TemporaryName;
  name->is_used = true;
  name->next = temporary_names;
  while (!temporary_names.compare_exchange_weak(name->next, name)) {
  }
  return name;
}

std::string folder_for(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  return folder.empty() ? "." : folder.string();
}

// The name of a temporary file consists of the name of the final file, this text, and two numbers.
constexpr std::string_view before_numbers = ".relievo-";

// Returns the part of a temporary file's path that precedes the two numbers. The file's name is cut so that the
// whole name has a length that file systems allow.
std::string stem_for(const std::string& path) {
  constexpr std::size_t most =
      NAME_MAX - before_numbers.size() - 1 - 2 * 10;  // two numbers of ten digits each follow
  const std::filesystem::path whole = path;
  return (whole.parent_path() / (whole.filename().string().substr(0, most).append(before_numbers))).string();
}

std::string own_path(const Descriptor& file) {
  return "/proc/self/fd/" + std::to_string(file.number());
}

// Makes a file without a name. Returns a closed descriptor if the file system could not give this file a name
// later.
Descriptor make_nameless(const std::string& folder, unsigned mode) {
  Descriptor file(::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, mode));
  return file.is_open() && ::access(own_path(file).c_str(), F_OK) == 0 ? std::move(file) : Descriptor(-1);
}

// The attribute that marks files with temporary names. A file's name alone would not prove that this program
// made the file.
constexpr const char* mark = "user.relievo.unfinished";

// Marks a file, and locks it until this process closes it. On a file system without attributes or locks the
// file stays unmarked or unlocked.
void mark_unfinished(const Descriptor& file) {
  ::flock(file.number(), LOCK_EX | LOCK_NB);
  ::fsetxattr(file.number(), mark, "", 0, 0);
}

// Removes the unfinished files in `folder` whose names start with `begin` and which no process has open. The
// name is tested because a file with its final name must stay, even if it still has the mark: its process may
// have been killed just after renaming it.
void remove_abandoned(const std::string& folder, const std::string& begin) {
  std::error_code failed;
  for (std::filesystem::directory_iterator entry(folder, failed), end; !failed && entry != end;
       entry.increment(failed)) {
    const std::string name = entry->path().filename().string();
    if (!name.starts_with(begin) || !name.contains(before_numbers)) continue;
    const Descriptor file(::open(entry->path().c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    if (file.is_open() && ::fgetxattr(file.number(), mark, nullptr, 0) >= 0 &&
        ::flock(file.number(), LOCK_EX | LOCK_NB) == 0)
      ::unlink(entry->path().c_str());
  }
}

void remove_abandoned_for(const std::string& stem) {
  remove_abandoned(folder_for(stem), std::filesystem::path(stem).filename().string());
}

Descriptor make_named(TemporaryName& name, const std::string& stem, unsigned mode) {
  remove_abandoned_for(stem);
  while (name.renew(stem)) {
    const FileChange change;
    Descriptor file(::open(name.text, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, mode));
    name.is_there = file.is_open();
    if (file.is_open()) mark_unfinished(file);
    if (file.is_open() || errno != EEXIST) return file;
  }
  return Descriptor(-1);
}

bool link_to(const std::string& own, const char* path) {
  return ::linkat(AT_FDCWD, own.c_str(), AT_FDCWD, path, AT_SYMLINK_FOLLOW) == 0;
}

// Replaces the file at `path`. The new file gets a temporary name first, because only a file with a name can
// be renamed.
bool name_in_place(const Descriptor& file, const std::string& own, const std::string& path) {
  const std::string stem = stem_for(path);
  remove_abandoned_for(stem);
  mark_unfinished(file);
  errno = EEXIST;
  for (TemporaryName name; errno == EEXIST && name.renew(stem);) {
    // Nothing below may allocate memory, because the handler of a failed allocation waits for the end of
    // every FileChange.
    const FileChange change;
    if (!link_to(own, name.text)) continue;
    if (::rename(name.text, path.c_str()) == 0) return true;
    const int reason = errno;
    ::unlink(name.text);
    errno = reason;
    return false;
  }
  return false;
}

// Gives the name `path` to a file without a name, and replaces an existing file. Returns whether it
// succeeded.
bool name_file(const Descriptor& file, const std::string& path) {
  const std::string own = own_path(file);
  const auto link = [&] {
    const FileChange change;
    return link_to(own, path.c_str());
  };
  return link() || (errno == EEXIST && name_in_place(file, own, path));
}

}  // namespace

TemporaryFile::TemporaryFile(const std::string& path, unsigned mode)
    : path_(path), file_(make_nameless(folder_for(path), mode)) {
  if (file_.is_open()) return;
  name_ = take_name();
  file_ = make_named(*name_, stem_for(path), mode);
}

TemporaryFile::~TemporaryFile() {
  if (!name_) return;
  if (name_->is_there.exchange(false)) ::unlink(name_->text);
  name_->is_used = false;
}

Result<void> TemporaryFile::append(std::span<const std::byte> bytes) {
  if (!file_.is_open())
    return system_error(ErrorKind::output, path_, "expected a place that can be written to");
  if (write_all(file_.number(), bytes)) return {};
  return system_error(ErrorKind::output, path_, "expected room to write the file");
}

Result<void> TemporaryFile::finish() {
  if (::fsync(file_.number()) == 0) return {};
  return system_error(ErrorKind::output, path_, "expected room to write the file");
}

Result<void> TemporaryFile::keep(const std::string& path) {
  bool is_kept = false;
  if (!name_) {
    is_kept = name_file(file_, path);
  } else {
    const FileChange change;
    is_kept = ::rename(name_->text, path.c_str()) == 0;
    if (is_kept) name_->is_there = false;
  }
  if (!is_kept) return system_error(ErrorKind::output, path, "expected a file that can be replaced");
  ::fremovexattr(file_.number(), mark);
  return {};
}

void remove_abandoned_files(const std::string& folder) {
  remove_abandoned(folder, "");
}

void remove_temporary_files() {
  is_ending = true;
  while (threads_with_change > 0) ::sched_yield();
  for (const TemporaryName* name = temporary_names; name != nullptr; name = name->next)
    if (name->is_there) ::unlink(name->text);
}

void remove_temporary_files_on_signals() {
  std::signal(SIGXFSZ, SIG_IGN);  // a file above the size limit then gives an error, as on a full disk
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
