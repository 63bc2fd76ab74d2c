#include "studio/disk/state_folder.h"

#include <fcntl.h>
#include <sys/file.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "common/files.h"
#include "common/owned_folder.h"
#include "relievo/core/text.h"

namespace relievo::app::studio {
namespace {

namespace fs = std::filesystem;

constexpr int most_studios = 9;  // largest number of studios of a user that run at the same time
constexpr std::string_view mark_owner = "studio";
constexpr unsigned private_folder = 0700;

// Locks the folder until this program ends. Returns a closed descriptor if that fails; errno then has the
// reason.
Descriptor lock_of(const std::string& folder) {
  const std::string path = folder + "/lock";
  Descriptor lock(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600));
  if (lock.is_open() && ::flock(lock.number(), LOCK_EX | LOCK_NB) != 0) lock.close();
  return lock;
}

// Returns the absolute path without a slash at its end. A suffix such as -2 can be appended to it.
std::string plain_path(const std::string& path) {
  std::error_code failed;
  const fs::path whole = fs::absolute(fs::path(path) / ".", failed).lexically_normal().parent_path();
  return failed ? path : whole.string();
}

// Returns the standard folder for the state of programs. If the user has no home, returns a temporary folder.
std::string default_state_folder() {
  const std::string state = environment_variable("XDG_STATE_HOME"), home = environment_variable("HOME");
  if (!state.empty()) return state + "/relievo";
  if (!home.empty()) return home + "/.local/state/relievo";
  std::error_code ignored;
  return (fs::temp_directory_path(ignored) / "relievo").string();
}

}  // namespace

bool own_state_folder(const std::string& folder) {
  return own_folder(folder, mark_owner, private_folder) == Ownership::owned;
}

Result<StateFolder> take_state_folder(const std::string& chosen) {
  const std::string first = plain_path(chosen.empty() ? default_state_folder() : chosen);
  std::string reason = "Another studio uses the folder";
  StateFolder folder;
  for (int i = 1; i <= most_studios; ++i) {
    folder.path = i == 1 ? first : cat(first, "-", i);
    const Ownership found = own_folder(folder.path, mark_owner, private_folder);
    folder.is_ours = found == Ownership::owned;
    if (found == Ownership::of_others && i == 1) {
      if (!chosen.empty())
        return option_error(
            "state",
            cat("expected an empty folder, or one of relievo studio, found other files in '", chosen, "'"));
      reason = "Files of others are in the folder";
    }
    if (found == Ownership::of_others) continue;
    if (found == Ownership::owned) folder.lock = lock_of(folder.path);
    if (folder.lock.is_open()) {
      if (i == 1) return folder;
      folder.notice =
          cat(reason, " in which a studio usually keeps its work: this one keeps its own work apart.");
      folder.detail = cat("It does so in ", folder.path, ".");
      return folder;
    }
    if (found != Ownership::owned || errno != EWOULDBLOCK) break;
  }
  folder.detail = cat(folder.path, ": ", std::strerror(errno));
  folder.notice = "Your work is not kept, as the studio's folder cannot be written to.";
  return folder;
}

}  // namespace relievo::app::studio
