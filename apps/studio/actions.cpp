#include "studio/actions.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>

#include "common/files.h"
#include "common/read_inputs.h"
#include "relievo/core/text.h"
#include "studio/requests.h"

namespace relievo::app::studio {
namespace {

using Json = nlohmann::json;

constexpr std::size_t most_thumbnail = 200'000;  // bytes

double time_of(const Json& state) {
  const Json time = state.value("changed", Json());
  return time.is_number() ? time.get<double>() : 0;
}

bool is_there(const ScanSource& input) {
  return !input.sample.empty() || file_size(input.path);
}

// Returns an error if a scan's path is that of a device or a folder. Accepts a missing file.
Result<void> check_place(const ScanSource& input) {
  return is_there(input) || !app::is_there(input.path) ? Result<void>{} : check_file(input.path);
}

Answer done() {
  return answer_of(Json::object());
}

Answer not_open() {
  return answer_of(Json{{"error", {{"kind", "closed"}, {"text", "expected a document that is open"}}}}, 409);
}

std::string* text_of(Json& options, const char* option) {
  const auto found = options.find(option);
  return found == options.end() ? nullptr : found->get_ptr<std::string*>();
}

std::vector<Json*> option_lists(Json& project) {
  std::vector<Json*> lists{&project["options"]};
  if (Json& studio = project["studio"]; studio.is_object()) {
    if (studio.contains("kept")) lists.push_back(&studio["kept"]);
    if (studio.contains("snapshots"))
      for (Json& snapshot : studio["snapshots"])
        if (snapshot.is_object()) lists.push_back(&snapshot["options"]);
  }
  std::erase_if(lists, [](const Json* list) { return !list->is_object(); });
  return lists;
}

Result<std::shared_ptr<const PackedFile>> packed(const std::string& path, const std::string& name) {
  RELIEVO_TRY(std::vector<std::byte> bytes, read_file(path));
  return std::make_shared<const PackedFile>(name, std::move(bytes));
}

Result<ScanSource> input_in(const Json& json) {
  return input_from_json(json.value("input", Json()), "input");
}

}  // namespace

const std::map<std::string, Actions::Action, std::less<>> Actions::actions_{
    {"document", &Actions::document},
    {"open", &Actions::open},
    {"leave", &Actions::leave},
    {"state", &Actions::keep},
    {"thumbnail", &Actions::keep_thumbnail},
    {"recent", &Actions::recent},
    {"kept", &Actions::kept_amount},
    {"remove", &Actions::remove},
    {"save", &Actions::save},
    {"status", &Actions::status},
    {"check", &Actions::check}};

Actions::Actions(OpenDocuments& documents, Store& store) : documents_(documents), store_(store) {}

bool Actions::has(std::string_view name) const {
  return actions_.contains(name) || find_engine_action(name) != nullptr;
}

Answer Actions::run(std::string_view name, const Json& json) {
  Result<Answer> made = [&]() -> Result<Answer> {
    if (const auto found = actions_.find(name); found != actions_.end()) return (this->*found->second)(json);
    const auto engine = documents_.find(json.value("document", ""));
    return engine ? find_engine_action(name)(*engine, json) : not_open();
  }();
  return made ? *std::move(made) : answer_of(made.error());
}

// Returns the stored state of a document; null if none is stored.
Result<Json> Actions::kept_state(const std::string& id) const {
  RELIEVO_TRY(const std::string text, store_.document(id));
  const Json state = Json::parse(text, nullptr, false);
  return state.is_object() ? state : Json();
}

// Returns the time at which the newest known state of a document was changed. The caller has locked `storing_`.
Result<double> Actions::time_of_newest(const std::string& id) {
  const std::optional<double> known = opened_.with([&](const std::map<std::string, Opened>& opened) {
    const auto found = opened.find(id);
    return found == opened.end() ? std::nullopt : std::optional(found->second.time_ms);
  });
  if (known) return *known;
  RELIEVO_TRY(const Json state, kept_state(id));
  return state.is_object() ? time_of(state) : 0;
}

Result<std::shared_ptr<Engine>> Actions::open_document(const ScanSource& input, const std::string& tab) {
  const std::string id = document_of(input);
  const auto engine = documents_.open(id, tab);
  const Lock lock(storing_);
  RELIEVO_TRY(const double time_ms, time_of_newest(id));
  Opened now{input, time_ms, {}};
  opened_.with([&](std::map<std::string, Opened>& opened) {
    std::erase_if(opened, [&](const auto& each) { return !documents_.is_open(each.first); });
    if (const auto found = opened.find(id); found != opened.end()) now.tab = found->second.tab;
    opened[id] = std::move(now);
  });
  return engine;
}

// Answers with a scan's document and the document's stored state. If the scan's file is missing, but the user
// has dropped a file with the same bytes on the page, the answer is about the document of the dropped file;
// `moved` is then the stored state of the missing file's document.
Result<Answer> Actions::document(const Json& json) {
  RELIEVO_TRY(ScanSource input, input_in(json));
  const Lock lock(storing_);
  Json moved;
  if (const auto same = is_there(input) ? std::nullopt : store_.find_scan(input.hash)) {
    RELIEVO_TRY(moved, kept_state(document_of(input)));
    input = *same;
  }
  RELIEVO_CHECK(check_place(input));
  const std::string id = document_of(input);
  RELIEVO_TRY(const Json kept, kept_state(id));
  return answer_of(Json{{"document", id},
                        {"input", to_json(input)},
                        {"is_there", is_there(input)},
                        {"kept", kept},
                        {"moved", moved}});
}

Result<Answer> Actions::open(const Json& json) {
  RELIEVO_TRY(const ScanSource input, input_in(json));
  const std::string id = document_of(input);
  RELIEVO_TRY(const auto engine, open_document(input, json.value("tab", "")));
  engine->show(input, view_values(json));
  const Lock lock(storing_);
  store_.touch(id);
  return answer_of(Json{{"document", id}});
}

Result<Answer> Actions::leave(const Json& json) {
  documents_.leave(json.value("tab", ""));
  return done();
}

// Returns whether a document was opened or is stored. The caller has locked `storing_`.
bool Actions::is_known(const std::string& id) {
  return opened_.with([&](const auto& opened) { return opened.contains(id); }) || store_.document(id) != "";
}

// Stores the state of a document, or answers with status 409 if a newer state is already stored.
Result<Answer> Actions::keep(const Json& json) {
  const std::string id = json.value("document", "");
  const Json state = json.value("state", Json());
  if (!state.is_object()) return refusal(400, "expected a state");
  const Lock lock(storing_);
  if (is_document(id) && !is_known(id) && !input_of(state.dump()))
    return refusal(400, "expected the state of a document with a scan");
  RELIEVO_TRY(const double newest, time_of_newest(id));
  if (time_of(state) < newest)
    return answer_of(Json{{"error", {{"kind", "older"}, {"text", "a newer state is kept"}}}}, 409);
  RELIEVO_CHECK(store_.keep_document(id, state.dump(), json.value("is_moving", false)));
  // A page that stores this document has taken the project with which the program was started. The document
  // is now newer than the project, so later pages must not open the project.
  if (first_.contains("options")) {
    RELIEVO_TRY(const ScanSource first, input_in(first_));
    if (document_of(first) == id) first_.erase("options");
  }
  opened_.with([&](std::map<std::string, Opened>& opened) {
    const auto found = opened.find(id);
    if (found == opened.end()) return;
    found->second.time_ms = time_of(state);
    found->second.tab = json.value("tab", "");
  });
  return done();
}

Result<Answer> Actions::keep_thumbnail(const Json& json) {
  const std::string thumbnail = json.value("thumbnail", "");
  if (!thumbnail.starts_with("data:image/jpeg;base64,") || thumbnail.size() > most_thumbnail)
    return refusal(400, "expected a thumbnail");
  const std::string id = json.value("document", "");
  const Lock lock(storing_);
  if (is_document(id) && !is_known(id)) return refusal(400, "expected the thumbnail of a kept document");
  RELIEVO_CHECK(store_.keep_thumbnail(id, thumbnail));
  return done();
}

Result<Answer> Actions::recent(const Json& json) {
  const std::string after = json.value("after", "");
  const Lock lock(storing_);
  return answer_of(Json{{"recent", recent_list(after)}});
}

// Returns the list of Store::recent(). If `after` is empty, the list begins with the documents that are being
// opened, because these are stored only after their scan was read. The caller has locked `storing_`.
Json Actions::recent_list(const std::string& after) {
  Json list = Json::array();
  const auto opened = opened_.with([](const auto& all) { return all; });
  for (const OpenDocuments::Entry& entry : documents_.all()) {
    const auto found = opened.find(entry.document);
    if (!after.empty() || found == opened.end() || entry.engine->status().error ||
        store_.document(entry.document) != "")
      continue;
    list.push_back({{"document", entry.document},
                    {"input", to_json(found->second.input)},
                    {"is_there", true},
                    {"thumbnail", ""}});
  }
  for (const KeptDocument& kept : store_.recent(after))
    list.push_back({{"document", kept.id},
                    {"input", to_json(kept.input)},
                    {"is_there", kept.is_scan_there},
                    {"thumbnail", kept.thumbnail}});
  return list;
}

Result<Answer> Actions::kept_amount(const Json&) {
  const Lock lock(storing_);
  const KeptAmount kept = store_.amount();
  return answer_of(Json{{"documents", kept.documents}, {"bytes", kept.bytes}});
}

// Deletes a document for ever, unless another tab shows it.
Result<Answer> Actions::remove(const Json& json) {
  const std::string id = json.value("document", "");
  if (!documents_.close(id, json.value("tab", "")))
    return refusal(409, "expected a document that no other tab shows");
  const Lock lock(storing_);
  opened_.with([&](std::map<std::string, Opened>& opened) { opened.erase(id); });
  RELIEVO_CHECK(store_.remove(id));
  return done();
}

// Makes a project file with the scan and the files of the options packed in it.
Result<Answer> Actions::save(const Json& json) {
  Json project = json.value("project", Json());
  RELIEVO_TRY(const ScanSource input, input_in(project));
  ProjectFile file;
  for (Json* const options : option_lists(project)) {
    RELIEVO_TRY(OrnamentFiles files,
                pack_ornaments(text_of(*options, "font"), text_of(*options, "ornaments")));
    file.ornaments.merge(files);
  }
  const bool is_sample = !input.sample.empty();
  if ((is_sample && file.ornaments.empty()) || ending_of(input.path) == "json")
    return refusal(400, "expected a scan of one file");
  if (!is_sample) {
    RELIEVO_TRY(file.scan, packed(input.path, input.name));
  }
  if (const std::string path = base_image_path_in(project["options"]); !path.empty()) {
    RELIEVO_TRY(file.base_image, packed(path, plain_name(path)));
  }
  file.text = project.dump(1) + "\n";
  RELIEVO_TRY(const std::vector<std::byte> bytes, pack_project(file));
  return Answer{200, "application/zip", std::string(text_in(bytes))};
}

Answer Actions::take_scan(const std::string& name, const BodyReader& read) {
  const std::unique_ptr<DroppedScan> scan = store_.begin_scan(name);
  if (!read([&](std::string_view bytes) { return scan->append(bytes); })) return {};
  if (const auto ok = scan->finish(); !ok) return answer_of(ok.error());
  const Lock lock(storing_);
  const Result<ScanSource> input = store_.keep(*scan);
  return input ? answer_of(Json{{"input", to_json(*input)}}) : answer_of(input.error());
}

Answer Actions::take_project(const std::string& name, const BodyReader& read) {
  std::vector<std::byte> body;
  const auto take = [&](std::string_view bytes) {
    const auto more = std::as_bytes(std::span(bytes));
    body.insert(body.end(), more.begin(), more.end());
    return Result<void>{};
  };
  if (!read(take)) return {};
  const Result<Json> project = project_in(body, name, {});
  return project ? answer_of(*project) : answer_of(project.error());
}

Result<ScanSource> Actions::kept(const PackedFile& file) {
  const std::unique_ptr<DroppedScan> scan = store_.begin_scan(file.name);
  RELIEVO_CHECK(scan->append(text_in(file.bytes)));
  RELIEVO_CHECK(scan->finish());
  return store_.keep(*scan);
}

// Stores the fonts and drawings that were packed in a project. Then replaces the paths of fonts and drawings in the
// project's options and in the options of its snapshots. The path of a file whose hash is in the store becomes the path
// of the stored copy. Any other relative path is made relative to `folder`.
Result<void> Actions::place_ornaments(const OrnamentFiles& inside, const std::string& folder, Json& project) {
  for (const auto& [name, bytes] : inside) RELIEVO_CHECK(kept({name, bytes}));
  const auto place = [&](const std::string& name) {
    std::string path = inside.contains(name) ? name : path_in(folder, name);
    const std::string digits = std::filesystem::path(path).parent_path().filename().string();
    const bool is_known = is_document(digits) && (inside.contains(name) || !app::is_there(path));
    const auto stored = is_known ? store_.find_scan("fnv1a64:" + digits) : std::nullopt;
    return stored ? stored->path : path;
  };
  for (Json* const options : option_lists(project))
    change_ornament_paths(text_of(*options, "font"), text_of(*options, "ornaments"), place);
  return {};
}

// Returns the content of a project file as JSON for the page. A relative path starts at `folder`.
Result<Json> Actions::project_in(std::span<const std::byte> bytes, const std::string& name,
                                 const std::string& folder) {
  RELIEVO_TRY(const ProjectFile file, unpack_project(bytes, name));
  RELIEVO_TRY(Project project, read_project(file.text, name));
  RELIEVO_CHECK(take_text_of_file("strokes", folder, project.options));
  RELIEVO_TRY(const ReliefOptions read, parse_options(project.options));
  RELIEVO_CHECK(parse_depth(project.options));
  ScanSource& input = project.input;
  const Lock lock(storing_);
  if (file.scan) {
    RELIEVO_TRY(input, kept(*file.scan));
  }
  std::string& image = project.base_image_path;
  if (file.base_image) {
    RELIEVO_TRY(const ScanSource kept_image, kept(*file.base_image));
    image = kept_image.path;
  } else if (!image.empty() && !folder.empty()) {
    image = (std::filesystem::path(folder) / image).lexically_normal().string();
  }
  if (!folder.empty() && input.sample.empty())
    input.path = (std::filesystem::path(folder) / input.path).lexically_normal().string();
  if (!is_there(input)) input = store_.find_scan(input.hash).value_or(input);
  RELIEVO_CHECK(check_place(input));
  Json options = app::to_json(project.options), usual = Json::object();
  for (const OptionRow& option : option_table())
    if (option.is_stated && option.is_number()) usual[option.name] = option.access.number(read).value_or(0);
  if (!image.empty()) options["base-image"] = image;
  Json all{{"input", app::to_json(input)},
           {"is_there", is_there(input)},
           {"options", std::move(options)},
           {"usual", std::move(usual)},
           {"studio", Json::parse(file.text).value("studio", Json::object())}};
  RELIEVO_CHECK(place_ornaments(file.ornaments, folder, all));
  return all;
}

Result<void> Actions::begin_with(const std::string& path, const std::string& full) {
  RELIEVO_TRY(const std::vector<std::byte> bytes, read_file(path));
  const std::filesystem::path place = full;
  if (ending_of(path) == "relievo") {
    RELIEVO_TRY(first_, project_in(bytes, path, place.parent_path().string()));
    return {};
  }
  const ScanSource input{{}, place.lexically_normal().string(), place.filename().string(), {}};
  first_ = {{"input", to_json(input)}, {"is_there", true}};
  // The page opens a stored document itself, with the view in its state.
  if (store_.document(document_of(input)) == "") {
    RELIEVO_TRY(const auto engine, open_document(input, {}));
    engine->open(input, first_view());
  }
  return {};
}

Result<Answer> Actions::status(const Json& json) {
  const std::string id = json.value("document", "");
  const auto engine = documents_.find(id);
  return engine ? answer_of(status_of({id, engine})) : not_open();
}

Json Actions::status_of(const OpenDocuments::Entry& entry) {
  Json json = to_json(entry.engine->status());
  json["document"] = entry.document;
  json["kept"] = opened_.with([&](const std::map<std::string, Opened>& opened) {
    const auto found = opened.find(entry.document);
    const Opened none, &known = found == opened.end() ? none : found->second;
    return Json{{"changed", known.time_ms}, {"tab", known.tab}};
  });
  return json;
}

std::vector<Json> Actions::statuses() {
  std::vector<Json> all;
  for (const OpenDocuments::Entry& entry : documents_.all()) all.push_back(status_of(entry));
  return all;
}

}  // namespace relievo::app::studio
