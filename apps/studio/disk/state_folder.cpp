#include "studio/disk/state_folder.h"

#include <fcntl.h>
#include <sys/file.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "common/files.h"
#include "common/owned_folder.h"
#include "relievo/core/text.h"
#include "studio/store.h"

namespace relievo::app::studio {
namespace {

namespace fs = std::filesystem;

constexpr int most_studios = 9;  // that keep their work side by side
constexpr std::string_view mark_owner = "studio";
constexpr unsigned private_folder = 0700;

std::string variable(const char* name) {
  const char* const value = std::getenv(name);
  return value ? value : "";
}

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(fs::symlink_status(path, ignored));
}

// Returns whether all entries of a folder, which may be missing, are as wanted.
bool is_each(const fs::path& folder, bool (*is_wanted)(const fs::path&)) {
  std::error_code failed;
  const fs::file_status status = fs::symlink_status(folder, failed);
  if (!fs::exists(status)) return true;
  if (!fs::is_directory(status)) return false;
  for (fs::directory_iterator entry(folder, failed), end; !failed && entry != end; entry.increment(failed))
    if (!is_wanted(entry->path())) return false;
  return !failed;
}

bool is_kept_document(const fs::path& path) {
  const std::string ending = path.extension().string(), stem = path.stem().string();
  const bool is_unfinished = ending.starts_with(".relievo-") && is_document(stem.substr(0, stem.find('.')));
  return is_file(path) &&
         ((is_document(stem) && (ending == ".json" || ending == ".picture")) || is_unfinished);
}

bool is_kept_scan(const fs::path& path) {
  return is_document(path.filename().string()) && is_each(path, is_file);
}

bool is_of_state(const fs::path& path) {
  const std::string name = path.filename().string();
  if (name == "documents") return is_each(path, is_kept_document);
  if (name == "scans") return is_each(path, is_kept_scan);
  return is_file(path) && (name == "lock" || name == "address.json" || name.starts_with("upload.relievo-"));
}

// Versions of 2026 marked no folder. One of theirs has an empty lock and an address with a token, and nothing that is not a
// studio's.
bool is_former(const fs::path& folder) {
  const auto address = nlohmann::json::parse(text_of_file(folder / "address.json"), nullptr, false);
  const bool has_token = address.is_object() && address.contains("port") && address.contains("token");
  return has_token && file_size(folder / "lock") == 0 && is_each(folder, is_of_state);
}

Ownership own_or_adopt(const std::string& folder) {
  const Ownership found = own_folder(folder, mark_owner, private_folder);
  return found == Ownership::of_others && is_former(folder) ? mark_folder(folder, mark_owner) : found;
}

// Locks the folder until this program ends; otherwise errno tells why not.
Descriptor lock_of(const std::string& folder) {
  const std::string path = folder + "/lock";
  Descriptor lock(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600));
  if (lock.is_open() && ::flock(lock.number(), LOCK_EX | LOCK_NB) != 0) lock.close();
  return lock;
}

// Returns the path without a slash at its end, so that another name can be made of it.
std::string plain_path(const std::string& path) {
  std::error_code failed;
  const fs::path whole = fs::absolute(fs::path(path) / ".", failed).lexically_normal().parent_path();
  return failed ? path : whole.string();
}

}  // namespace

bool own_state_folder(const std::string& folder) {
  return own_folder(folder, mark_owner, private_folder) == Ownership::owned;
}

std::string default_state_folder() {
  const std::string state = variable("XDG_STATE_HOME"), home = variable("HOME");
  if (!state.empty()) return state + "/relievo";
  if (!home.empty()) return home + "/.local/state/relievo";
  std::error_code ignored;
  return (fs::temp_directory_path(ignored) / "relievo").string();
}

Result<StateFolder> take_state_folder(const std::string& chosen) {
  const std::string first = plain_path(chosen.empty() ? default_state_folder() : chosen);
  std::string reason = "Another studio uses ";
  StateFolder folder;
  for (int i = 1; i <= most_studios; ++i) {
    folder.path = i == 1 ? first : cat(first, "-", i);
    const Ownership found = own_or_adopt(folder.path);
    folder.is_ours = found == Ownership::owned;
    if (found == Ownership::of_others && i == 1) {
      if (!chosen.empty())
        return option_error(
            "state",
            cat("expected an empty folder, or one of relievo studio, found other files in '", chosen, "'"));
      reason = "Files of others are in ";
    }
    if (found == Ownership::of_others) continue;
    if (found == Ownership::owned) folder.lock = lock_of(folder.path);
    if (folder.lock.is_open()) {
      if (i > 1) folder.notice = cat(reason, first, ": this one keeps its work in ", folder.path, ".");
      return folder;
    }
    if (found != Ownership::owned || errno != EWOULDBLOCK) break;
  }
  folder.notice =
      cat("Your work is not kept, as ", folder.path, " cannot be written to: ", std::strerror(errno), ".");
  return folder;
}

}  // namespace relievo::app::studio
