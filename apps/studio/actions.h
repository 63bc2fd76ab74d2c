// The actions that the page can ask for, as JSON in and out. Tested by apps/studio/tests/server.test.mjs.
#pragma once

#include "studio/answers.h"

#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "studio/open_documents.h"
#include "studio/store.h"

namespace relievo::app::studio {

constexpr std::size_t most_scan = std::size_t{4} << 30;  // bytes of a dropped file

// Every method may be called from any thread.
class Actions {
 public:
  Actions(OpenDocuments& documents, const Store& store);

  bool has(std::string_view name) const;

  // Does the action of that name, which has() knows.
  void run(std::string_view name, const nlohmann::json& json, httplib::Response& response);

  // Takes a file of the browser piece by piece: a scan, or a project with or without its scan.
  void take_scan(const httplib::Request& request, httplib::Response& response,
                 const httplib::ContentReader& read);
  void take_project(const httplib::Request& request, httplib::Response& response,
                    const httplib::ContentReader& read);

  // Has the first page begin with a scan or a project. Errors: kind input if it cannot be read.
  Result<void> begin_with(const std::string& path);

  // Returns what the page needs to know before it can show anything.
  nlohmann::json about();

  // Returns, for each open document, its engine's status and when and by which tab it was kept last.
  std::vector<nlohmann::json> statuses();

 private:
  using Action = void (Actions::*)(const nlohmann::json&, httplib::Response&);

  // When a document was changed, in milliseconds since 1970, and by which tab.
  struct Change {
    double time_ms = 0;
    std::string tab;
  };

  void document(const nlohmann::json& json, httplib::Response& response);
  void open(const nlohmann::json& json, httplib::Response& response);
  void leave(const nlohmann::json& json, httplib::Response& response);
  void keep(const nlohmann::json& json, httplib::Response& response);
  void keep_picture(const nlohmann::json& json, httplib::Response& response);
  void recent(const nlohmann::json& json, httplib::Response& response);
  void save(const nlohmann::json& json, httplib::Response& response);

  std::shared_ptr<Engine> engine_of(const nlohmann::json& json, httplib::Response& response);
  void view(const nlohmann::json& json, httplib::Response& response);
  void cancel(const nlohmann::json& json, httplib::Response& response);
  void facts(const nlohmann::json& json, httplib::Response& response);
  void views(const nlohmann::json& json, httplib::Response& response);
  void status(const nlohmann::json& json, httplib::Response& response);
  void frame(const nlohmann::json& json, httplib::Response& response);
  void scan(const nlohmann::json& json, httplib::Response& response);
  void profile(const nlohmann::json& json, httplib::Response& response);
  void reach(const nlohmann::json& json, httplib::Response& response);
  void check(const nlohmann::json& json, httplib::Response& response);
  void piece(const nlohmann::json& json, httplib::Response& response);
  void cancel_piece(const nlohmann::json& json, httplib::Response& response);
  void make_file(const nlohmann::json& json, httplib::Response& response);

  Result<nlohmann::json> project_in(std::span<const std::byte> bytes, const std::string& name,
                                    const std::string& folder);
  nlohmann::json recent_list() const;
  nlohmann::json kept_state(const std::string& id) const;
  Change& change_of(const std::string& id);
  nlohmann::json status_of(const OpenDocuments::Entry& entry);

  static const std::map<std::string, Action, std::less<>> actions_;

  OpenDocuments& documents_;
  const Store& store_;
  std::mutex storing_;                     // guards the store and what follows
  std::map<std::string, Change> changes_;  // by document
  nlohmann::json first_;                   // with which the first page begins; null for nothing
};

}  // namespace relievo::app::studio
