#include "common/owned_folder.h"

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <span>

#include "common/files.h"
#include "common/temporary_file.h"
#include "relievo/core/text.h"

namespace relievo::app {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view mark_name = ".relievo_folder";

std::string mark_of(std::string_view owner) {
  return cat("relievo ", owner,
             " made this folder or found it empty, and may remove what it has put here.\n");
}

fs::path mark_in(const std::string& folder) {
  return fs::path(folder) / mark_name;
}

// Reads the mark of a folder. Returns `owned` if the mark names that owner, `of_others` if the mark is
// missing or names another owner, and `unusable` if the mark cannot be read.
Ownership read_mark(const std::string& folder, std::string_view owner) {
  std::error_code ignored;
  const fs::path mark = mark_in(folder);
  if (!fs::is_regular_file(fs::symlink_status(mark, ignored))) return Ownership::of_others;
  const auto bytes = read_file(mark.string());
  if (const int reason = errno; !bytes && is_there(mark.string())) {
    errno = reason;
    return Ownership::unusable;
  }
  return bytes && text_in(*bytes) == mark_of(owner) ? Ownership::owned : Ownership::of_others;
}

// Returns whether the folder is empty. A mark that another process has not finished writing does not count.
bool is_empty(const std::string& folder, std::error_code& failed) {
  const std::string unfinished = cat(mark_name, ".");
  fs::directory_iterator entry(folder, failed);
  return !failed && std::all_of(entry, fs::directory_iterator(), [&](const fs::directory_entry& each) {
    return each.path().filename().string().starts_with(unfinished);
  });
}

// Writes the mark into a folder, even if the folder has other files. Returns `owned` or `unusable`.
Ownership mark_folder(const std::string& folder, std::string_view owner) {
  const std::string path = mark_in(folder).string(), text = mark_of(owner);
  TemporaryFile mark(path);
  const bool is_marked = mark.append(std::as_bytes(std::span(text))) && mark.finish() && mark.keep(path);
  return is_marked ? Ownership::owned : Ownership::unusable;
}

}  // namespace

Ownership ownership_of(const std::string& folder, std::string_view owner) {
  if (!is_there(folder) && errno == ENOENT) return Ownership::free;
  if (const Ownership found = read_mark(folder, owner); found != Ownership::of_others) return found;
  std::error_code failed;
  const bool is_free = is_empty(folder, failed);
  if (failed) {
    errno = failed.value();
    return Ownership::unusable;
  }
  if (is_free) return Ownership::free;
  return read_mark(folder, owner);  // reads it again, as another process may have marked the folder meanwhile
}

Ownership own_folder(const std::string& folder, std::string_view owner, unsigned mode) {
  const Ownership found = ownership_of(folder, owner);
  if (found != Ownership::free) return found;
  std::error_code failed;
  if (const fs::path parent = fs::path(folder).parent_path(); !parent.empty())
    fs::create_directories(parent, failed);
  if (failed) errno = failed.value();
  if (failed || (::mkdir(folder.c_str(), mode) != 0 && errno != EEXIST)) return Ownership::unusable;
  return mark_folder(folder, owner);
}

}  // namespace relievo::app
