#include "studio/store.h"

#include <fcntl.h>
#include <sys/file.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>

#include "common/files.h"
#include "relievo/core/text.h"

namespace relievo::app::studio {
namespace {

namespace fs = std::filesystem;

constexpr int most_studios = 9;  // that keep their work side by side
constexpr const char* unfinished_name = "upload";

std::string read_text(const fs::path& path) {
  const auto bytes = read_file(path.string());
  return bytes ? std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size()) : std::string();
}

std::string variable(const char* name) {
  const char* const value = std::getenv(name);
  return value ? value : "";
}

// Returns the last part of a path, without anything that a file system could read as more than a name.
std::string plain_name(const std::string& name) {
  std::string plain = fs::path(name).filename().string();
  std::erase_if(plain, [](unsigned char c) { return c < 32 || c == '/' || c == '\\'; });
  if (plain.size() > 120) plain = plain.substr(plain.size() - 120);
  return plain.empty() || plain == "." || plain == ".." ? "scan" : plain;
}

}  // namespace

std::string Store::default_folder() {
  const std::string state = variable("XDG_STATE_HOME"), home = variable("HOME");
  if (!state.empty()) return state + "/relievo";
  if (!home.empty()) return home + "/.local/state/relievo";
  std::error_code ignored;
  return (fs::temp_directory_path(ignored) / "relievo").string();
}

Store::Store(const std::string& folder) : folder_(folder) {
  for (int i = 1; i <= most_studios; ++i) {
    folder_ = i == 1 ? folder : cat(folder, "-", i);
    if (claim(folder_)) {
      if (i > 1) notice_ = cat("Another studio uses ", folder, ": this one keeps its work in ", folder_, ".");
      return;
    }
    if (errno != EWOULDBLOCK) break;
  }
  notice_ = cat("Your work is not kept, as ", folder_, " cannot be written to: ", std::strerror(errno), ".");
}

// Locks the folder until this program ends; otherwise errno tells why not.
bool Store::claim(const std::string& folder) {
  std::error_code ignored;
  fs::create_directories(folder, ignored);
  fs::permissions(folder, fs::perms::owner_all, ignored);
  lock_ = Descriptor(::open((folder + "/lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600));
  if (!lock_.is_open() || ::flock(lock_.number(), LOCK_EX | LOCK_NB) != 0) return false;
  std::vector<fs::path> unfinished;  // of a studio that was killed
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (entry.path().stem() == unfinished_name) unfinished.push_back(entry.path());
  for (const fs::path& path : unfinished) fs::remove(path, ignored);
  return true;
}

Result<void> Store::write(const std::string& name, std::string_view text) const {
  std::error_code ignored;
  const fs::path path = fs::path(folder_) / name;
  fs::create_directories(path.parent_path(), ignored);
  const OutputFile file{path.string(), bytes_of(text)};
  return write_files({&file, 1});
}

std::string Store::state() const {
  return read_text(fs::path(folder_) / "state.json");
}

Result<void> Store::keep_state(std::string_view state) const {
  return write("state.json", state);
}

std::vector<ScanSource> Store::recent() const {
  std::vector<ScanSource> inputs;
  const nlohmann::json json =
      nlohmann::json::parse(read_text(fs::path(folder_) / "recent.json"), nullptr, false);
  if (!json.is_array()) return inputs;
  for (const nlohmann::json& entry : json) {
    Result<ScanSource> input = input_from_json(entry, "recent.json");
    std::error_code ignored;
    if (input && (!input->sample.empty() || fs::exists(input->path, ignored))) inputs.push_back(*input);
  }
  return inputs;
}

Result<void> Store::remember(const ScanSource& input) const {
  std::vector<ScanSource> inputs = recent();
  std::erase_if(inputs, [&](const ScanSource& other) { return is_same(other, input); });
  inputs.insert(inputs.begin(), input);
  if (inputs.size() > most_recent) inputs.resize(most_recent);
  nlohmann::json json = nlohmann::json::array();
  for (const ScanSource& entry : inputs) json.push_back(to_json(entry));
  remove_old_scans(inputs);
  return write("recent.json", json.dump(1));
}

DroppedScan::DroppedScan(const std::string& folder, const std::string& name)
    : name_(plain_name(name)), file_((fs::path(folder) / unfinished_name).string()) {}

Result<void> DroppedScan::append(std::string_view bytes) {
  hash_.append(bytes);
  return file_.append(std::as_bytes(std::span(bytes)));
}

DroppedScan Store::begin_scan(const std::string& name) const {
  return {folder_, name};
}

Result<ScanSource> Store::keep(DroppedScan& scan) const {
  const std::string hash = scan.hash_.text();
  const fs::path path = fs::path(folder_) / "scans" / hash.substr(hash.find(':') + 1) / scan.name_;
  std::error_code ignored;
  fs::create_directories(path.parent_path(), ignored);
  RELIEVO_CHECK(scan.file_.append({}));
  RELIEVO_CHECK(scan.file_.finish());
  RELIEVO_CHECK(scan.file_.keep(path.string()));
  return ScanSource{{}, path.string(), scan.name_, hash};
}

void Store::remove_old_scans(const std::vector<ScanSource>& recent) const {
  std::error_code ignored;
  std::vector<fs::path> old;
  for (const auto& entry : fs::directory_iterator(fs::path(folder_) / "scans", ignored)) {
    const auto is_in_it = [&](const ScanSource& input) {
      return fs::path(input.path).parent_path() == entry.path();
    };
    if (std::ranges::none_of(recent, is_in_it)) old.push_back(entry.path());
  }
  for (const fs::path& path : old) fs::remove_all(path, ignored);
}

}  // namespace relievo::app::studio
