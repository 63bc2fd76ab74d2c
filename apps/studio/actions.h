// Performs the actions that the studio's page requests. Requests and results are JSON. Tested by
// apps/studio/tests/server.test.mjs.
#pragma once

#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "common/project_file.h"
#include "relievo/core/parallel.h"
#include "studio/answers.h"
#include "studio/open_documents.h"
#include "studio/store.h"

namespace relievo::app::studio {

constexpr std::uint64_t most_scan = std::uint64_t{4} << 30;  // largest file that a user can drop, in bytes

// Reads the body of a request in blocks and passes each to `take`. Returns whether the whole body arrived and
// `take` accepted all of it.
using BodyReader = std::function<bool(const std::function<Result<void>(std::string_view)>& take)>;

// A function that performs an action on the engine of the document that the request names.
using EngineAction = Result<Answer> (*)(Engine&, const nlohmann::json&);

// Returns the action of that name; null if there is none.
EngineAction find_engine_action(std::string_view name);

// The actions of the studio's server. Every method may be called from any thread.
class Actions {
 public:
  Actions(OpenDocuments& documents, Store& store);

  bool has(std::string_view name) const;

  // Performs the action of that name, for which has() must return true.
  Answer run(std::string_view name, const nlohmann::json& json);

  // Receive a file that the browser sends in blocks: a scan, or a project file with or without its scan. If the body
  // does not arrive completely, the answer is empty.
  Answer take_scan(const std::string& name, const BodyReader& read);
  Answer take_project(const std::string& name, const BodyReader& read);

  // Makes the first page open a scan or a project. `full` is the absolute path of the file. Errors: kind
  // input if the file cannot be read.
  Result<void> begin_with(const std::string& path, const std::string& full);

  // Returns the facts that the page needs at its start.
  nlohmann::json about();

  // Returns the following for each open document: the status of its engine, the time of its last stored
  // change, and the tab that made this change.
  std::vector<nlohmann::json> statuses();

 private:
  using Action = Result<Answer> (Actions::*)(const nlohmann::json&);

  // An open document: its scan, the time of its last change in milliseconds since 1970, and the tab that
  // changed it.
  struct Opened {
    ScanSource input;
    double time_ms = 0;
    std::string tab;
  };

  Result<Answer> document(const nlohmann::json& json);
  Result<Answer> open(const nlohmann::json& json);
  Result<Answer> leave(const nlohmann::json& json);
  Result<Answer> keep(const nlohmann::json& json);
  Result<Answer> keep_thumbnail(const nlohmann::json& json);
  Result<Answer> recent(const nlohmann::json& json);
  Result<Answer> kept_amount(const nlohmann::json& json);
  Result<Answer> remove(const nlohmann::json& json);
  Result<Answer> save(const nlohmann::json& json);
  Result<Answer> status(const nlohmann::json& json);
  Result<Answer> check(const nlohmann::json& json);

  Result<ScanSource> kept(const PackedFile& file);
  Result<void> place_ornaments(const OrnamentFiles& inside, const std::string& folder,
                               nlohmann::json& project);
  Result<nlohmann::json> project_in(std::span<const std::byte> bytes, const std::string& name,
                                    const std::string& folder);
  nlohmann::json recent_list(const std::string& after = {});
  Result<nlohmann::json> kept_state(const std::string& id) const;
  Result<double> time_of_newest(const std::string& id);
  bool is_known(const std::string& id);
  Result<std::shared_ptr<Engine>> open_document(const ScanSource& input, const std::string& tab);
  nlohmann::json status_of(const OpenDocuments::Entry& entry);

  static const std::map<std::string, Action, std::less<>> actions_;

  OpenDocuments& documents_;
  Store& store_;
  Mutex storing_;         // guards store_ and first_; it stays locked while the disk works
  nlohmann::json first_;  // the input that the first page opens, or null
  // The open documents by their ids. They are locked only briefly. A thread that has locked storing_ may lock them.
  Guarded<std::map<std::string, Opened>> opened_;
};

}  // namespace relievo::app::studio
