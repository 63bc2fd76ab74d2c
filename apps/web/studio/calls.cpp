// Answers the calls of the studio's page. Some calls are requests that the native studio gets by HTTP. The
// others ask for work that the native studio does with files and threads.
#include "web/calls.h"

#include <map>
#include <span>

#include "common/files.h"
#include "relievo/core/text.h"
#include "studio/actions.h"
#include "studio/answers.h"
#include "studio/store.h"
#include "web/studio/apart.h"

// Sends the statuses of the open documents, as JSON, to the host after one has changed. The host provides
// this function in the module "relievo".
__attribute__((import_module("relievo"), import_name("statuses"))) extern "C" void relievo_host_statuses(
    const char* json, std::size_t size);

namespace relievo::app::web {
namespace {

using Json = nlohmann::json;

struct ScanInMemory final : studio::DroppedScan {
  explicit ScanInMemory(const std::string& scan) : name(studio::plain_name(scan)) {}

  Result<void> append(std::string_view more) override {
    hash.append(more);
    const auto added = std::as_bytes(std::span(more));
    bytes.insert(bytes.end(), added.begin(), added.end());
    return {};
  }

  std::string name;
  FileHash hash;
  std::vector<std::byte> bytes;
};

std::string folder_of(std::string_view hash) {
  return cat("scans/", hash.substr(hash.find(':') + 1), "/");
}

// Names scans by their hash, and keeps their bytes until the page takes them. Documents are stored by
// apps/web/page/store.js instead.
class BrowserStore final : public studio::Store {
 public:
  std::unique_ptr<studio::DroppedScan> begin_scan(const std::string& name) const override {
    return std::make_unique<ScanInMemory>(name);
  }

  Result<ScanSource> keep(studio::DroppedScan& scan) override {
    auto& kept = static_cast<ScanInMemory&>(scan);  // begin_scan() made it, so it has this type
    const std::string hash = kept.hash.text();
    ScanSource source{{}, folder_of(hash) + kept.name, kept.name, hash};
    bytes_[source.path] = std::move(kept.bytes);
    return source;
  }

  std::optional<ScanSource> find_scan(const std::string& hash) const override {
    const std::string folder = folder_of(hash);
    const auto found = bytes_.lower_bound(folder);
    if (found == bytes_.end() || !found->first.starts_with(folder)) return std::nullopt;
    return ScanSource{{}, found->first, found->first.substr(folder.size()), hash};
  }

  // Returns the bytes of the scan that was kept under that path. A second call returns an empty vector.
  std::vector<std::byte> take_bytes(const std::string& path) { return std::exchange(bytes_[path], {}); }

 private:
  std::map<std::string, std::vector<std::byte>> bytes_;  // maps paths to contents
};

void tell_statuses();

struct Studio {
  BrowserStore store;
  studio::OpenDocuments documents{tell_statuses};
  studio::Actions actions{documents, store};
};

Studio& the_studio() {
  static Studio studio;
  return studio;
}

void tell_statuses() {
  const Json all = the_studio().actions.statuses();
  const std::string text = all.dump(-1, ' ', false, Json::error_handler_t::replace);
  relievo_host_statuses(text.data(), text.size());
}

CallAnswer call_answer(const studio::Answer& from, Json json) {
  for (const auto& [name, value] : from.headers) json["facts"] = Json::parse(value, nullptr, false);
  json["status"] = from.status;
  json["type"] = from.type;
  const auto bytes = std::as_bytes(std::span(from.body));
  return {std::move(json), {bytes.begin(), bytes.end()}};
}

// Reads a project file that the page has added under a path. After that, the call "unpacked" returns the bytes of
// each file in the project file.
Result<CallAnswer> take_project(const Json& json) {
  RELIEVO_TRY(const std::vector<std::byte> bytes, read_file(json.value("path", "")));
  const studio::BodyReader whole = [&](const auto& take) { return take(text_in(bytes)).has_value(); };
  return call_answer(the_studio().actions.take_project(json.value("name", ""), whole), Json::object());
}

}  // namespace

Result<CallAnswer> call(std::string_view name, const Json& json) {
  Studio& studio = the_studio();
  if (name == "about") return call_answer(studio::answer_of(studio.actions.about()), Json::object());
  if (name == "hash") {
    RELIEVO_TRY(const std::string hash, hash_of_file(json.value("path", "")));
    return CallAnswer{{{"hash", hash}}};
  }
  if (name == "project") return take_project(json);
  if (name == "unpacked") return CallAnswer{Json::object(), studio.store.take_bytes(json.value("path", ""))};
  if (name == "work") {
    studio.documents.work();
    return CallAnswer{};
  }
  if (name == "draw") {
    RELIEVO_TRY(const studio::Answer drawn, draw(json));
    return call_answer(drawn, Json::object());
  }
  if (name == "picture" && json.value("apart", false))
    if (const auto engine = studio.documents.find(json.value("document", "")))
      return call_answer(undrawn_frame(*engine, json), Json::object());
  if (!studio.actions.has(name))
    return option_error("call", cat("expected the name of a function, found '", name, "'"));
  const studio::Answer made = studio.actions.run(name, json);
  if (name != "picture") tell_statuses();
  return call_answer(made, Json::object());
}

}  // namespace relievo::app::web
