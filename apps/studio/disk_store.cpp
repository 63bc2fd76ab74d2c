#include "studio/disk_store.h"

#include <fcntl.h>
#include <sys/file.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <span>

#include "common/files.h"
#include "common/scene_file.h"
#include "common/temporary_file.h"
#include "relievo/core/text.h"

namespace relievo::app::studio {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr int most_studios = 9;  // that keep their work side by side
constexpr const char* unfinished_name = "upload";
constexpr const char* documents = "documents";  // the folder

std::string variable(const char* name) {
  const char* const value = std::getenv(name);
  return value ? value : "";
}

// A dropped scan in a temporary file.
struct ScanFile final : DroppedScan {
  ScanFile(const std::string& folder, const std::string& scan)
      : name(plain_name(scan)), file((fs::path(folder) / unfinished_name).string()) {}

  Result<void> append(std::string_view bytes) override {
    hash.append(bytes);
    return file.append(std::as_bytes(std::span(bytes)));
  }

  std::string name;
  FileHash hash;
  TemporaryFile file;
};

Result<void> check_id(const std::string& id) {
  if (is_document(id)) return {};
  return std::unexpected(Error{ErrorKind::input, "document", {}, "expected the name of a document"});
}

}  // namespace

std::string DiskStore::default_folder() {
  const std::string state = variable("XDG_STATE_HOME"), home = variable("HOME");
  if (!state.empty()) return state + "/relievo";
  if (!home.empty()) return home + "/.local/state/relievo";
  std::error_code ignored;
  return (fs::temp_directory_path(ignored) / "relievo").string();
}

DiskStore::DiskStore(const std::string& folder) : folder_(folder) {
  for (int i = 1; i <= most_studios; ++i) {
    folder_ = i == 1 ? folder : cat(folder, "-", i);
    if (claim(folder_)) {
      take_former_state();
      remove_old_scans();
      if (i > 1) notice_ = cat("Another studio uses ", folder, ": this one keeps its work in ", folder_, ".");
      return;
    }
    if (errno != EWOULDBLOCK) break;
  }
  notice_ = cat("Your work is not kept, as ", folder_, " cannot be written to: ", std::strerror(errno), ".");
}

// Locks the folder until this program ends; otherwise errno tells why not.
bool DiskStore::claim(const std::string& folder) {
  std::error_code ignored;
  fs::create_directories(folder, ignored);
  fs::permissions(folder, fs::perms::owner_all, ignored);
  lock_ = Descriptor(::open((folder + "/lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600));
  if (!lock_.is_open() || ::flock(lock_.number(), LOCK_EX | LOCK_NB) != 0) return false;
  std::vector<fs::path> unfinished;  // of a studio that was killed
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (entry.path().stem() == unfinished_name) unfinished.push_back(entry.path());
  for (const auto& entry : fs::directory_iterator(fs::path(folder) / documents, ignored))
    if (entry.path().extension() != ".json" && entry.path().extension() != ".picture")
      unfinished.push_back(entry.path());
  for (const fs::path& path : unfinished) fs::remove(path, ignored);
  return true;
}

Result<void> DiskStore::write(const std::string& name, std::string_view text, bool is_durable) const {
  std::error_code ignored;
  const fs::path path = fs::path(folder_) / name;
  fs::create_directories(path.parent_path(), ignored);
  TemporaryFile file(path.string());
  RELIEVO_CHECK(file.append(std::as_bytes(std::span(text))));
  RELIEVO_CHECK(file.finish(is_durable));
  return file.keep(path.string());
}

std::string DiskStore::document(const std::string& id) const {
  return is_document(id) ? text_of_file(fs::path(folder_) / documents / (id + ".json")) : std::string();
}

Result<void> DiskStore::keep_document(const std::string& id, std::string_view state, bool is_moving) {
  RELIEVO_CHECK(check_id(id));
  return write(cat(documents, "/", id, ".json"), state, !is_moving);
}

Result<void> DiskStore::keep_picture(const std::string& id, std::string_view picture) {
  RELIEVO_CHECK(check_id(id));
  return write(cat(documents, "/", id, ".picture"), picture, false);
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
  for (const auto& entry : fs::directory_iterator(fs::path(folder_) / documents, ignored))
    if (entry.path().extension() == ".json" && is_document(entry.path().stem().string()))
      found.emplace_back(entry.last_write_time(ignored), entry.path().stem().string());
  std::ranges::sort(found, std::greater());
  if (found.size() > most_recent) found.resize(most_recent);
  std::vector<std::string> ids;
  for (auto& [time, id] : found) ids.push_back(std::move(id));
  return ids;
}

std::vector<KeptDocument> DiskStore::recent() const {
  std::vector<KeptDocument> all;
  for (const std::string& id : newest_documents()) {
    const std::optional<ScanSource> input = input_of(document(id));
    if (!input) continue;
    std::error_code ignored;
    const bool is_there = !input->sample.empty() || fs::exists(input->path, ignored);
    all.push_back({id, *input, is_there, text_of_file(fs::path(folder_) / documents / (id + ".picture"))});
  }
  return all;
}

// Versions before kept one document only.
void DiskStore::take_former_state() {
  const fs::path former = fs::path(folder_) / "state.json";
  const std::string state = text_of_file(former);
  const std::optional<ScanSource> input = input_of(state);
  if (!input || !keep_document(document_of(*input), state, false)) return;
  std::error_code ignored;
  fs::remove(former, ignored);
}

StudioAddress DiskStore::address() const {
  const Json json = Json::parse(text_of_file(fs::path(folder_) / "address.json"), nullptr, false);
  if (!json.is_object() || !json.value("port", Json()).is_number_integer() ||
      !json.value("token", Json()).is_string())
    return {};
  return {json["port"].get<int>(), json["token"].get<std::string>()};
}

// Who knows the address may use the studio: nobody else can read the folder.
void DiskStore::keep_address(const StudioAddress& address) const {
  (void)write("address.json", Json{{"port", address.port}, {"token", address.token}}.dump());
}

std::unique_ptr<DroppedScan> DiskStore::begin_scan(const std::string& name) const {
  return std::make_unique<ScanFile>(folder_, name);
}

Result<ScanSource> DiskStore::keep(DroppedScan& scan) {
  auto& kept = static_cast<ScanFile&>(scan);  // which begin_scan() made
  const std::string text = kept.hash.text();
  const fs::path path = fs::path(folder_) / "scans" / text.substr(text.find(':') + 1) / kept.name;
  std::error_code ignored;
  fs::create_directories(path.parent_path(), ignored);
  RELIEVO_CHECK(kept.file.append({}));
  RELIEVO_CHECK(kept.file.finish());
  RELIEVO_CHECK(kept.file.keep(path.string()));
  return ScanSource{{}, path.string(), kept.name, text};
}

std::optional<ScanSource> DiskStore::find_scan(const std::string& hash) const {
  const std::string digits = hash.substr(hash.find(':') + 1);
  if (!is_document(digits)) return std::nullopt;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(fs::path(folder_) / "scans" / digits, ignored))
    return ScanSource{{}, entry.path().string(), entry.path().filename().string(), hash};
  return std::nullopt;
}

void DiskStore::remove_old_scans() const {
  std::set<fs::path> used;
  for (const KeptDocument& kept : recent()) {
    const fs::path path = kept.input.path;
    used.insert(path.parent_path());
    for (const std::string& image : base_images_of(document(kept.id)))
      used.insert(fs::path(image).parent_path());
    if (path.extension() != ".json") continue;
    const auto models =
        read_scene_file(text_of_file(path), path.string());  // of several files that were dropped
    for (const SceneEntry& model : models.value_or(std::vector<SceneEntry>()))
      used.insert(fs::path(model.path).parent_path());
  }
  std::error_code ignored;
  std::vector<fs::path> old;
  for (const auto& entry : fs::directory_iterator(fs::path(folder_) / "scans", ignored))
    if (!used.contains(entry.path())) old.push_back(entry.path());
  for (const fs::path& path : old) fs::remove_all(path, ignored);
}

}  // namespace relievo::app::studio
