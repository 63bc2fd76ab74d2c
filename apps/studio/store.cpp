#include "studio/store.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>

#include "common/files.h"
#include "relievo/core/text.h"

namespace relievo::app::studio {
namespace {

namespace fs = std::filesystem;

std::string read_text(const fs::path& path) {
  const auto bytes = read_file(path.string());
  return bytes ? std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size()) : std::string();
}

std::string variable(const char* name) {
  const char* const value = std::getenv(name);
  return value ? value : "";
}

bool is_same(const ScanSource& a, const ScanSource& b) {
  return a.sample == b.sample && a.path == b.path;
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

Result<void> Store::write(const std::string& name, std::string_view text) const {
  std::error_code ignored;
  const fs::path path = fs::path(folder_) / name;
  fs::create_directories(path.parent_path(), ignored);
  fs::permissions(folder_, fs::perms::owner_all, ignored);
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

Result<ScanSource> Store::keep_scan(std::string_view bytes, const std::string& name) const {
  const std::string hash = hash_of(bytes), plain = plain_name(name);
  const std::string place = cat("scans/", hash.substr(hash.find(':') + 1), "/", plain);
  if (auto ok = write(place, bytes); !ok) return std::unexpected(ok.error());
  return ScanSource{{}, (fs::path(folder_) / place).string(), plain, hash};
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
