#include "studio/disk/disk_store.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>

#include "common/files.h"
#include "common/owned_folder.h"
#include "common/temporary_file.h"
#include "relievo/core/text.h"

namespace relievo::app::studio {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr const char* documents = "documents";  // names of folders
constexpr const char* scans = "scans";
constexpr unsigned private_file = 0600;
constexpr int most_studios = 9;  // largest number of studios of a user that run at the same time
constexpr std::string_view mark_owner = "studio";
constexpr unsigned private_folder = 0700;

// Returns the error for a file that cannot be stored. `reason` is the value of errno.
std::unexpected<Error> not_kept(int reason) {
  const bool is_full = reason == ENOSPC || reason == EDQUOT || reason == EFBIG;
  return std::unexpected(Error{
      ErrorKind::output,
      {},
      {},
      is_full ? "expected room to write the file, but the disk is full"
              : cat("expected a folder of the studio that can be written to: ", std::strerror(reason))});
}

struct ScanFile final : DroppedScan {
  ScanFile(const std::string& folder, const std::string& scan)
      : name(plain_name(scan)), file((fs::path(folder) / "upload").string(), private_file) {}

  Result<void> append(std::string_view bytes) override {
    hash.append(bytes);
    if (file.append(std::as_bytes(std::span(bytes)))) return {};
    return not_kept(errno);
  }

  Result<void> finish() override {
    if (file.append({}) && file.finish()) return {};
    return not_kept(errno);
  }

  std::string name;
  FileHash hash;
  TemporaryFile file;
};

Result<std::string> read_kept(const std::string& path) {
  const auto bytes = read_file(path);
  if (bytes) return std::string(text_in(*bytes));
  return std::unexpected(
      Error{ErrorKind::output,
            {},
            {},
            cat("expected a folder of the studio that can be read: ", bytes.error().expected)});
}

Result<void> check_id(const std::string& id) {
  if (is_document(id)) return {};
  return std::unexpected(Error{ErrorKind::input, "document", {}, "expected the name of a document"});
}

// Makes a folder that only the user who runs the studio may read.
bool make_folder(const fs::path& path) {
  return ::mkdir(path.c_str(), 0700) == 0 || errno == EEXIST;
}

// Returns the entries of a folder; none if the path is a link to a folder.
std::vector<fs::directory_entry> entries_of(const fs::path& folder) {
  std::error_code failed;
  std::vector<fs::directory_entry> entries;
  if (!fs::is_directory(fs::symlink_status(folder, failed))) return entries;
  for (fs::directory_iterator entry(folder, failed), end; !failed && entry != end; entry.increment(failed))
    entries.push_back(*entry);
  return entries;
}

// Removes the unfinished files that a killed studio left in a folder. Does nothing if the path is a link to a
// folder.
void remove_left_files(const fs::path& folder) {
  std::error_code failed;
  if (fs::is_directory(fs::symlink_status(folder, failed))) remove_abandoned_files(folder.string());
}

std::uint64_t bytes_in(const fs::path& folder) {
  std::uint64_t bytes = 0;
  for (const fs::directory_entry& entry : entries_of(folder))
    bytes += app::file_size(entry.path()).value_or(0);
  return bytes;
}

std::string digits_of(const std::string& hash) {
  return hash.substr(hash.find(':') + 1);
}

// Finds the stored scans that a text mentions, and returns the names of their folders. The text is a document
// with all its undo steps, or a scene file.
std::set<std::string> scans_in(std::string_view text) {
  constexpr std::string_view before = "/scans/";
  constexpr std::size_t digits = 16;
  std::set<std::string> found;
  for (std::size_t at = text.find(before); at != std::string_view::npos; at = text.find(before, at + 1))
    if (const std::string_view name = text.substr(at + before.size(), digits); is_document(name))
      found.emplace(name);
  return found;
}

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

// Makes the folder with the mark of a studio if it is missing. Returns whether the folder now has that mark.
bool own_state_folder(const std::string& folder) {
  return own_folder(folder, mark_owner, private_folder) == Ownership::owned;
}

}  // namespace

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

DiskStore::DiskStore(StateFolder folder)
    // If the folder is not ours, uses /dev/null instead. No file can exist below /dev/null, so nothing is
    // found or stored.
    : folder_(folder.is_ours ? std::move(folder.path) : "/dev/null"),
      notice_(std::move(folder.notice)),
      lock_(std::move(folder.lock)) {
  std::set<std::string> kept;
  remove_left_files(folder_);
  remove_left_files(fs::path(folder_) / documents);
  for (const fs::directory_entry& entry : entries_of(fs::path(folder_) / scans)) {
    remove_left_files(entry.path());
    kept.insert(entry.path().filename().string());
  }
  remove_unneeded(kept);
}

Result<void> DiskStore::write(const std::string& name, std::string_view text, Durability durability) const {
  const fs::path path = fs::path(folder_) / name;
  errno = ENOENT;
  if (!own_state_folder(folder_) || (path.parent_path() != folder_ && !make_folder(path.parent_path())))
    return not_kept(errno);
  TemporaryFile file(path.string(), private_file);
  const bool is_kept = file.append(std::as_bytes(std::span(text))) &&
                       (durability == Durability::program || file.finish()) && file.keep(path.string());
  if (is_kept) return {};
  return not_kept(errno);
}

Result<std::string> DiskStore::document(const std::string& id) const {
  const std::string path = fs::path(folder_) / documents / (id + ".json");
  return is_document(id) && app::is_there(path) ? read_kept(path) : std::string();
}

Result<void> DiskStore::keep_document(const std::string& id, std::string_view state, bool is_moving) {
  RELIEVO_CHECK(check_id(id));
  RELIEVO_CHECK(
      write(cat(documents, "/", id, ".json"), state, is_moving ? Durability::program : Durability::machine));
  touch(id);  // because the kernel's own file times are too coarse for the order of documents
  return {};
}

Result<void> DiskStore::keep_thumbnail(const std::string& id, std::string_view thumbnail) {
  RELIEVO_CHECK(check_id(id));
  return write(cat(documents, "/", id, ".picture"), thumbnail, Durability::program);
}

void DiskStore::touch(const std::string& id) {
  std::error_code ignored;
  if (is_document(id))
    fs::last_write_time(fs::path(folder_) / documents / (id + ".json"), fs::file_time_type::clock::now(),
                        ignored);
}

std::vector<std::string> DiskStore::newest_documents() const {
  std::vector<std::pair<fs::file_time_type, std::string>> found;
  std::error_code ignored;
  for (const fs::directory_entry& entry : entries_of(fs::path(folder_) / documents))
    if (entry.path().extension() == ".json" && is_document(entry.path().stem().string()))
      found.emplace_back(entry.last_write_time(ignored), entry.path().stem().string());
  std::ranges::sort(found, std::greater());
  std::vector<std::string> ids;
  for (auto& [time, id] : found) ids.push_back(std::move(id));
  return ids;
}

std::vector<KeptDocument> DiskStore::recent(const std::string& after) const {
  std::vector<KeptDocument> all;
  bool is_before = !after.empty();
  for (const std::string& id : newest_documents()) {
    if (all.size() == most_recent) break;
    if (std::exchange(is_before, is_before && id != after)) continue;
    const std::optional<ScanSource> input = input_of(document(id).value_or(""));
    if (!input) continue;
    std::error_code ignored;
    const bool is_there = !input->sample.empty() || fs::exists(input->path, ignored);
    all.push_back({id, *input, is_there, text_of_file(fs::path(folder_) / documents / (id + ".picture"))});
  }
  return all;
}

KeptAmount DiskStore::amount() const {
  KeptAmount all{newest_documents().size(), bytes_in(fs::path(folder_) / documents)};
  for (const fs::directory_entry& scan : entries_of(fs::path(folder_) / scans))
    all.bytes += bytes_in(scan.path());
  return all;
}

Result<void> DiskStore::remove(const std::string& id) {
  RELIEVO_CHECK(check_id(id));
  RELIEVO_TRY(std::string text, document(id));
  RELIEVO_TRY(const std::set<std::string> its_scans, scans_of({std::move(text)}));
  std::error_code failed;
  for (const char* const ending : {".json", ".picture"})
    if (!failed) fs::remove(fs::path(folder_) / documents / (id + ending), failed);
  if (failed) return not_kept(failed.value());
  remove_unneeded(its_scans);
  return {};
}

StudioAddress DiskStore::address() const {
  const Json json = Json::parse(text_of_file(fs::path(folder_) / "address.json"), nullptr, false);
  if (!json.is_object() || !json.value("port", Json()).is_number_integer() ||
      !json.value("token", Json()).is_string())
    return {};
  return {json["port"].get<int>(), json["token"].get<std::string>()};
}

// Only the user may read the file (mode 0600), since anybody who knows the address could use the studio.
void DiskStore::keep_address(const StudioAddress& address) const {
  (void)write("address.json", Json{{"port", address.port}, {"token", address.token}}.dump(),
              Durability::machine);
}

std::unique_ptr<DroppedScan> DiskStore::begin_scan(const std::string& name) const {
  return std::make_unique<ScanFile>(folder_, name);
}

Result<ScanSource> DiskStore::keep(DroppedScan& scan) {
  auto& kept = static_cast<ScanFile&>(scan);  // begin_scan() made it, so it has this type
  const std::string text = kept.hash.text();
  const fs::path folder = fs::path(folder_) / scans / digits_of(text), path = folder / kept.name;
  const bool is_kept = own_state_folder(folder_) && make_folder(folder.parent_path()) &&
                       make_folder(folder) && kept.file.keep(path.string());
  if (is_kept) return ScanSource{{}, path.string(), kept.name, text};
  return not_kept(errno);
}

std::optional<ScanSource> DiskStore::find_scan(const std::string& hash) const {
  const std::string digits = digits_of(hash);
  if (!is_document(digits)) return std::nullopt;
  for (const fs::directory_entry& entry : entries_of(fs::path(folder_) / scans / digits))
    return ScanSource{{}, entry.path().string(), entry.path().filename().string(), hash};
  return std::nullopt;
}

// Returns the folders of the stored scans that the texts mention. If one of these scans is a scene file, also returns
// the folders of the scans that the scene file mentions.
Result<std::set<std::string>> DiskStore::scans_of(std::vector<std::string> texts) const {
  std::set<std::string> found;
  for (std::size_t i = 0; i < texts.size(); ++i)
    for (const std::string& scan : scans_in(texts[i])) {
      if (!found.insert(scan).second) continue;
      for (const fs::directory_entry& file : entries_of(fs::path(folder_) / scans / scan)) {
        if (file.path().extension() != ".json") continue;
        RELIEVO_TRY(texts.emplace_back(), read_kept(file.path()));
      }
    }
  return found;
}

// Removes the candidates that no document needs. Removes none if a document cannot be read. Keeps a file
// whose hash is not the name of its folder, because the studio did not put that file there.
void DiskStore::remove_unneeded(const std::set<std::string>& candidates) const {
  if (candidates.empty()) return;
  std::vector<std::string> texts;
  for (const std::string& id : newest_documents()) {
    Result<std::string> text = document(id);
    if (!text) return;
    texts.push_back(*std::move(text));
  }
  const Result<std::set<std::string>> needed = scans_of(std::move(texts));
  if (!needed) return;
  for (const std::string& scan : candidates) {
    if (!is_document(scan) || needed->contains(scan)) continue;
    const fs::path folder = fs::path(folder_) / scans / scan;
    std::error_code ignored;
    for (const fs::directory_entry& file : entries_of(folder))
      if (fs::is_regular_file(file.symlink_status(ignored)) &&
          digits_of(hash_of_file(file.path()).value_or("")) == scan)
        fs::remove(file.path(), ignored);
    if (!fs::is_symlink(folder, ignored)) ::rmdir(folder.c_str());  // fails if the folder has other files
  }
}

}  // namespace relievo::app::studio
